//! A series of files, one volume a frame, on one grid.

use crate::file::{Extent, VolumeFault, VolumeFile};
use crate::{Volume, VolumeError};

/// Why a series cannot be read; `E` is what opening a file ends with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SeriesError<E> {
    /// A file could not be opened.
    #[error("{0}")]
    Open(E),
    /// A file makes no volume.
    #[error("frame {frame}: {fault}")]
    Frame {
        /// Its number.
        frame: u32,
        /// Why.
        fault: VolumeFault,
    },
    /// The voxels of a file do not lie on the grid of the first one.
    #[error("the voxels of frame {frame} do not lie on the grid of frame {first}")]
    OtherGrid {
        /// Number of that file.
        frame: u32,
        /// Number of the first one.
        first: u32,
    },
    /// Two volumes do not lie on one grid.
    #[error(transparent)]
    Volume(#[from] VolumeError),
}

/// A series of files, opened one by one as frames are asked for.
///
/// All volumes lie in the one box that holds the voxels of every file, so that spheres can follow smoke from frame to
/// frame.
#[derive(Debug)]
pub struct Series<O> {
    open: O,
    extent: Extent,
    peak: f32,
    hottest: f32,
    notices: Vec<(u32, String)>,
}

impl<O, E> Series<O>
where
    O: FnMut(u32) -> Result<VolumeFile, E>,
{
    /// The series of the files that `open` gives by number. Opens each of them once to learn its box of voxels, and
    /// keeps none.
    ///
    /// # Errors
    ///
    /// [`SeriesError`] where a file cannot be opened, or lies on another grid.
    pub fn open(first: u32, last: u32, mut open: O) -> Result<Self, SeriesError<E>> {
        let mut extent = open(first).map_err(SeriesError::Open)?.extent();
        for frame in first.saturating_add(1)..=last {
            let own = open(frame).map_err(SeriesError::Open)?.extent();
            extent = extent
                .union(&own)
                .ok_or(SeriesError::OtherGrid { frame, first })?;
        }
        Ok(Self {
            open,
            extent,
            peak: 0.0,
            hottest: 0.0,
            notices: Vec::new(),
        })
    }

    /// The volume of a frame, in the box of all frames. Costs what opening its file does, and O(voxels of the box).
    ///
    /// # Errors
    ///
    /// [`SeriesError`] where the file cannot be opened or makes no volume.
    pub fn read(&mut self, frame: u32) -> Result<Volume, SeriesError<E>> {
        let file = (self.open)(frame).map_err(SeriesError::Open)?;
        let volume = file
            .volume(&self.extent)
            .map_err(|fault| SeriesError::Frame { frame, fault })?;
        self.peak = self.peak.max(volume.peak());
        self.hottest = self.hottest.max(volume.hottest());
        let own = file.notices().iter().cloned();
        let own = own.chain(volume.mended().notice());
        self.notices.extend(own.map(|notice| (frame, notice)));
        Ok(volume)
    }

    /// The box that holds the voxels of every file.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// The greatest density of the frames that were read.
    pub fn peak(&self) -> f32 {
        self.peak
    }

    /// The greatest temperature of the frames that were read.
    pub fn hottest(&self) -> f32 {
        self.hottest
    }

    /// What was guessed or mended, each with the number of its frame.
    pub fn notices(&self) -> &[(u32, String)] {
        &self.notices
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::VolumeOptions;
    use npr_vdb::testing::{Sample, SampleGrid};
    use npr_vdb::{Transform, ValueType};
    use proptest::prelude::*;

    type Voxels = Vec<([i32; 3], f32)>;

    fn sample(voxels: &Voxels, shift: f64) -> SampleGrid {
        let mut grid = SampleGrid::new("density", ValueType::Float);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        grid.transform = Transform::new(axes, [shift, 0.0, 0.0]).unwrap();
        let stored = voxels
            .iter()
            .map(|(at, value)| (*at, ([*value, 0.0, 0.0], true)));
        grid.voxels.extend(stored);
        grid
    }

    fn file(grid: SampleGrid) -> Result<VolumeFile, VolumeFault> {
        VolumeFile::read(&Sample::new(vec![grid]).bytes(), &VolumeOptions::default())
    }

    fn frames() -> impl Strategy<Value = Vec<Voxels>> {
        let voxel = (prop::array::uniform3(-9i32..12), 0.25f32..4.0);
        prop::collection::vec(prop::collection::vec(voxel, 1..6), 1..5)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn every_frame_lies_whole_in_the_box_of_all(frames in frames()) {
            let open = |frame: u32| file(sample(&frames[frame as usize - 1], 0.0));
            let mut series = Series::open(1, frames.len() as u32, open).unwrap();
            let mut peak = 0.0f32;
            for (number, voxels) in (1..).zip(&frames) {
                let volume = series.read(number).unwrap();
                let [x, y, z] = series.extent().size.map(|side| side as u32);
                prop_assert_eq!(volume.size(), [z, y, x]);
                let expected: f32 = sample(voxels, 0.0).voxels.values().map(|(value, _)| value[0]).sum();
                let sum: f32 = volume.density().iter().sum();
                prop_assert!((sum - expected).abs() < 1e-3 * expected, "{sum} for {expected}");
                peak = peak.max(volume.peak());
            }
            prop_assert_eq!(series.peak(), peak);
        }
    }

    #[test]
    fn a_frame_on_another_grid_is_named() {
        let speck = vec![([0; 3], 1.0)];
        let open = |frame: u32| file(sample(&speck, if frame == 3 { 0.5 } else { 0.0 }));
        let error = Series::open(1, 4, open).err();
        assert_eq!(error, Some(SeriesError::OtherGrid { frame: 3, first: 1 }));
        let open = |frame: u32| {
            if frame == 2 {
                Err("gone")
            } else {
                Ok(file(sample(&speck, 0.0)).unwrap())
            }
        };
        assert_eq!(
            Series::open(1, 4, open).err(),
            Some(SeriesError::Open("gone"))
        );
    }
}
