//! A series of volumes as a film: the smoke at any moment, between frames too.

use crate::motion::{between, estimate_velocity};
use crate::{Volume, VolumeError};

/// Volumes numbered in the order of time, read one by one as they are needed.
///
/// Where a volume brings no velocity, the motion to the next one is [estimated](estimate_velocity), so that spheres
/// follow the smoke and moments between frames show it once. Holds three volumes at a time. All of a series must lie
/// on one grid.
#[derive(Debug, Clone)]
pub struct Footage<R> {
    read: R,
    last: u32,
    frame_seconds: f32,
    /// By number: two that a moment lies between, and the one after, which the motion of the second leads to.
    held: Vec<(u32, Volume)>,
    estimates: bool,
}

impl<R, E> Footage<R>
where
    R: FnMut(u32) -> Result<Volume, E>,
    E: From<VolumeError>,
{
    /// A film whose frames `read` gives by number, each asked for once, in rising order if moments are; no frame
    /// follows `last`.
    ///
    /// `frame_seconds` lie between two frames.
    pub fn new(read: R, last: u32, frame_seconds: f32) -> Self {
        Self {
            read,
            last,
            frame_seconds,
            held: Vec::new(),
            estimates: false,
        }
    }

    /// The smoke at a moment, in frames: 2.5 lies half way from frame 2 to frame 3. Moments after the last frame show
    /// that one.
    ///
    /// Costs what reading does, and an estimate of motion where velocities are missing.
    ///
    /// # Errors
    ///
    /// What reading ends with, or [`VolumeError::DifferentGrids`].
    pub fn at(&mut self, moment: f64) -> Result<Volume, E> {
        let moment = moment.clamp(0.0, f64::from(self.last));
        // Of a number that is none, the first frame.
        let frame = moment.floor() as u32;
        let share = (moment - f64::from(frame)) as f32;
        let before = self.moving(frame)?;
        if frame >= self.last || share.is_nan() || share <= 0.0 {
            return Ok(before);
        }
        let after = self.moving(frame + 1)?;
        Ok(between(&before, &after, share, self.frame_seconds)?)
    }

    /// Whether any velocity that was used is an estimate.
    pub fn has_estimates(&self) -> bool {
        self.estimates
    }

    /// A frame with its own velocity or an estimated one; alone in its series, without any.
    fn moving(&mut self, frame: u32) -> Result<Volume, E> {
        let volume = self.frame(frame)?;
        if volume.velocity().is_some() {
            return Ok(volume);
        }
        let velocity = if frame < self.last {
            let next = self.frame(frame + 1)?;
            estimate_velocity(&volume, &next, self.frame_seconds)?
        } else if let Some(earlier) = self.earlier(frame) {
            // Nothing comes after the last frame; it goes on as it came.
            estimate_velocity(&earlier, &volume, self.frame_seconds)?
        } else {
            return Ok(volume);
        };
        self.estimates = true;
        let volume = volume.with_velocity(velocity)?;
        self.keep(frame, volume.clone());
        Ok(volume)
    }

    /// The frame before, if it is held.
    fn earlier(&self, frame: u32) -> Option<Volume> {
        let before = frame.checked_sub(1)?;
        let held = self.held.iter().find(|(number, _)| *number == before);
        held.map(|(_, volume)| volume.clone())
    }

    fn frame(&mut self, frame: u32) -> Result<Volume, E> {
        if let Some((_, volume)) = self.held.iter().find(|(number, _)| *number == frame) {
            return Ok(volume.clone());
        }
        let volume = (self.read)(frame)?;
        self.keep(frame, volume.clone());
        Ok(volume)
    }

    /// Holds a volume in place of the oldest one.
    fn keep(&mut self, frame: u32, volume: Volume) {
        self.held.retain(|(number, _)| *number != frame);
        self.held.push((frame, volume));
        self.held.sort_unstable_by_key(|(number, _)| *number);
        if self.held.len() > 3 {
            self.held.remove(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::blob;
    use glam::{DAffine3, Vec3};
    use proptest::prelude::*;

    /// A film of a volume whose densities are multiplied by the number of the frame, and the numbers that were read.
    fn film(
        last: u32,
        reads: &mut Vec<u32>,
    ) -> Footage<impl FnMut(u32) -> Result<Volume, VolumeError>> {
        let lump = blob([6, 5, 7], DAffine3::IDENTITY);
        let read = move |frame: u32| {
            reads.push(frame);
            let density = lump.density().iter().map(|d| d * frame as f32).collect();
            Volume::new(lump.size(), density, lump.index_to_world())
        };
        Footage::new(read, last, 0.1)
    }

    #[test]
    fn every_frame_is_read_once_and_motion_is_estimated_where_it_is_missing() {
        let mut reads = Vec::new();
        let mut footage = film(4, &mut reads);
        for quarter in 4..=20 {
            let volume = footage.at(f64::from(quarter) / 4.0).unwrap();
            assert!(volume.velocity().is_some());
        }
        assert!(footage.has_estimates());
        drop(footage);
        assert_eq!(reads, [1, 2, 3, 4]);
    }

    #[test]
    fn a_film_of_one_frame_stands_still() {
        let mut reads = Vec::new();
        let mut footage = film(1, &mut reads);
        let volume = footage.at(1.0).unwrap();
        assert!(volume.velocity().is_none() && !footage.has_estimates());
    }

    #[test]
    fn velocities_of_the_file_are_taken_as_they_are() {
        let read = |_: u32| {
            let volume = blob([4, 4, 4], DAffine3::IDENTITY);
            let count = volume.density().len();
            volume.with_velocity(vec![Vec3::X; count])
        };
        let mut footage = Footage::new(read, 9, 1.0);
        assert_eq!(footage.at(3.0).unwrap().velocity().unwrap()[0], Vec3::X);
        assert!(!footage.has_estimates());
    }

    #[test]
    fn what_reading_ends_with_is_handed_on() {
        let read = |_: u32| Err::<Volume, _>(VolumeError::BadTransform);
        assert_eq!(
            Footage::new(read, 9, 1.0).at(2.0),
            Err(VolumeError::BadTransform)
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn any_moment_lies_between_its_frames(moment in prop::num::f64::ANY, last in 1u32..5) {
            let mut reads = Vec::new();
            let mut footage = film(last, &mut reads);
            let volume = footage.at(moment).unwrap();
            let peak = volume.density().iter().fold(0.0f32, |most, d| most.max(*d));
            let lump = blob([6, 5, 7], DAffine3::IDENTITY);
            let unit = lump.density().iter().fold(0.0f32, |most, d| most.max(*d));
            let frame = if moment.is_nan() { 0.0 } else { moment.clamp(0.0, f64::from(last)) } as f32;
            prop_assert!(peak <= unit * frame.ceil() + 1e-4, "{peak} at {frame}");
        }
    }
}
