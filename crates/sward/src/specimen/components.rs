//! Leaves: triangles that hang together, and the root vertex of each.
//!
//! Chen & Johan 2015, §3.2. The paper searches breadth-first from each vertex; union-find gives the same groups in linear time with four
//! bytes a vertex. A group is named by its lowest vertex, so that nothing depends on the order of the work.

use super::progress::Share;
use super::vertex::SpecimenVertex;
use crate::math::mixed;

/// No vertex.
const NONE: u32 = u32::MAX;

/// Sets of vertices; each is named by its lowest.
struct Sets(Vec<u32>);

impl Sets {
    fn find(&mut self, mut vertex: u32) -> u32 {
        let above = &mut self.0;
        while above[vertex as usize] != vertex {
            let next = above[above[vertex as usize] as usize];
            above[vertex as usize] = next;
            vertex = next;
        }
        vertex
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        if a < b { self.0[b as usize] = a } else { self.0[a as usize] = b }
    }
}

fn place_hash(position: [f32; 3]) -> u32 {
    position.iter().fold(0, |hash: u32, part| mixed(hash.wrapping_mul(31) ^ part.to_bits()))
}

/// Joins vertices that lie in one place, bit by bit: an open table of the first vertex of each, at most two thirds full.
fn weld(sets: &mut Sets, vertices: &[SpecimenVertex], progress: &mut Share<'_, '_>) {
    let room = vertices.len() + vertices.len() / 2 + 1;
    let mut table = vec![NONE; room];
    for (index, vertex) in vertices.iter().enumerate() {
        progress.item(index, vertices.len());
        let bits = vertex.position.map(f32::to_bits);
        let mut slot = ((u64::from(place_hash(vertex.position)) * room as u64) >> 32) as usize;
        loop {
            let first = table[slot];
            if first == NONE {
                table[slot] = index as u32;
                break;
            }
            if vertices[first as usize].position.map(f32::to_bits) == bits {
                sets.join(first, index as u32);
                break;
            }
            slot = if slot + 1 == room { 0 } else { slot + 1 };
        }
    }
}

/// Gives each of the first `sums.len()` vertices, those of leaves, the place of its leaf's root: of the smallest u + v, of those the lowest.
/// How many leaves there are.
pub(super) fn root(vertices: &mut [SpecimenVertex], sums: &[f32], triangles: &[[u32; 3]], progress: &mut Share<'_, '_>) -> u32 {
    let count = sums.len();
    let vertices = &mut vertices[..count];
    let mut sets = Sets((0..count as u32).collect());
    let mut joining = progress.part(0.0, 0.3);
    for (index, [a, b, c]) in triangles.iter().enumerate() {
        joining.item(index, triangles.len());
        sets.join(*a, *b);
        sets.join(*b, *c);
    }
    weld(&mut sets, vertices, &mut progress.part(0.3, 0.8));
    let mut best = vec![NONE; count];
    let mut leaves = 0;
    let mut choosing = progress.part(0.8, 0.9);
    for vertex in 0..count {
        choosing.item(vertex, count);
        let set = sets.find(vertex as u32) as usize;
        leaves += u32::from(set == vertex);
        let known = best[set];
        if known == NONE || sums[vertex] < sums[known as usize] {
            best[set] = vertex as u32;
        }
    }
    let mut telling = progress.part(0.9, 1.0);
    for vertex in 0..count {
        telling.item(vertex, count);
        let set = sets.find(vertex as u32) as usize;
        vertices[vertex].root = vertices[best[set] as usize].position;
    }
    leaves
}
