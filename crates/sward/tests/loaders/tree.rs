//! Changes to a JSON value: numbers, kinds, missing and doubled parts.

use serde_json::{Value, json};

use crate::chance::Chance;

/// One to four changes.
pub(crate) fn mutate(root: &mut Value, chance: &mut Chance) {
    for _ in 0..1 + chance.below(4) {
        let other = somewhere(root, chance).clone();
        let place = somewhere(root, chance);
        once(place, other, chance);
    }
}

/// A value within a value: deeper ones more often than their share.
fn somewhere<'a>(mut value: &'a mut Value, chance: &mut Chance) -> &'a mut Value {
    loop {
        let inner = match value {
            Value::Array(list) => list.len(),
            Value::Object(map) => map.len(),
            _ => 0,
        };
        if inner == 0 || chance.one_in(8) {
            return value;
        }
        let chosen = chance.index(inner);
        value = match value {
            Value::Array(list) => &mut list[chosen],
            Value::Object(map) => map.values_mut().nth(chosen).expect("that many"),
            other => return other,
        };
    }
}

fn once(place: &mut Value, other: Value, chance: &mut Chance) {
    match place {
        Value::Array(list) if !list.is_empty() && chance.one_in(2) => match chance.below(4) {
            0 => drop(list.remove(chance.index(list.len()))),
            1 => list.push(list[chance.index(list.len())].clone()),
            2 => list.push(other),
            _ => {
                let times = 1 + chance.index(300);
                let element = list[chance.index(list.len())].clone();
                list.extend(vec![element; times]);
            }
        },
        Value::Object(map) if !map.is_empty() && chance.one_in(2) => {
            let key = map.keys().nth(chance.index(map.len())).expect("that many").clone();
            if chance.one_in(2) {
                map.remove(&key);
            } else {
                map.insert(key, other);
            }
        }
        _ => *place = if chance.one_in(3) { other } else { strange(place, chance) },
    }
}

/// Another value, mostly of the same kind.
fn strange(old: &Value, chance: &mut Chance) -> Value {
    let near = old.as_f64().unwrap_or(1.0);
    let numbers = [
        json!(0),
        json!(1),
        json!(2),
        json!(3),
        json!(-1),
        json!(7),
        json!(255),
        json!(5121),
        json!(5123),
        json!(5126),
        json!(65536),
        json!(2_147_483_647),
        json!(4_294_967_295_u64),
        json!(u64::MAX),
        json!(0.5),
        json!(1e-30),
        json!(1e9),
        json!(1e300),
        json!(near + 1.0),
        json!(near * 0.5),
    ];
    let kinds = [
        json!(null),
        json!([]),
        json!({}),
        json!(true),
        json!(""),
        json!("VEC3"),
        json!("SCALAR"),
        json!("MAT4"),
        json!("weights"),
        json!([[[[[1]]]]]),
    ];
    if let (Some(whole), true) = (old.as_u64(), chance.one_in(2)) {
        return json!(whole.wrapping_add(chance.below(5)).wrapping_sub(2));
    }
    if chance.one_in(6) { chance.pick(&kinds).clone() } else { chance.pick(&numbers).clone() }
}
