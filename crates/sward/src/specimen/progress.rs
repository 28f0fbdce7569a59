//! How far the work is, told in steps of at most 1 %.

/// Largest step that is told, as a share.
const STEP: f32 = 0.01;

/// What hears of shares done.
pub(super) struct Told<'a> {
    hear: &'a mut dyn FnMut(f32),
    told: f32,
}

impl<'a> Told<'a> {
    pub(super) fn new(hear: &'a mut dyn FnMut(f32)) -> Self {
        hear(0.0);
        Self { hear, told: 0.0 }
    }

    /// The work between two shares.
    pub(super) fn part<'b>(&'b mut self, from: f32, to: f32) -> Share<'a, 'b> {
        Share { told: self, from, to }
    }

    fn tell(&mut self, share: f32) {
        // What cannot say how far it is may take several steps at once: each is told, so that a bar never stands still for more.
        while share - self.told > STEP {
            self.told += STEP;
            (self.hear)(self.told);
        }
        if share > self.told {
            self.told = share;
            (self.hear)(share);
        }
    }
}

/// A part of the work.
pub(super) struct Share<'a, 'b> {
    told: &'b mut Told<'a>,
    from: f32,
    to: f32,
}

impl<'a> Share<'a, '_> {
    /// The part of it between two shares.
    pub(super) fn part<'c>(&'c mut self, from: f32, to: f32) -> Share<'a, 'c> {
        let at = |share: f32| self.from + share * (self.to - self.from);
        let (from, to) = (at(from), at(to));
        Share { told: self.told, from, to }
    }

    /// `done` of `all` items are done.
    pub(super) fn done(&mut self, done: usize, all: usize) {
        let share = if done < all { done as f32 / all as f32 } else { 1.0 };
        self.told.tell(self.from + share * (self.to - self.from));
    }

    /// Says so for every 65536th item.
    #[inline]
    pub(super) fn item(&mut self, item: usize, all: usize) {
        if item & 0xffff == 0 {
            self.done(item, all);
        }
    }
}
