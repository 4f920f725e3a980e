//! The most memory that a process held.

/// The most memory this process held at once, in bytes, as Linux counts resident pages; `None` elsewhere.
pub fn peak_bytes() -> Option<u64> {
    peak_in(&std::fs::read_to_string("/proc/self/status").ok()?)
}

/// The peak that a status file names.
fn peak_in(status: &str) -> Option<u64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_is_read_from_its_line() {
        let status = "VmPeak:\t  700 kB\nVmHWM:\t  312 kB\nVmRSS:\t  300 kB\n";
        assert_eq!(peak_in(status), Some(312 * 1024));
        assert_eq!(peak_in("VmRSS:\t 1 kB\n"), None);
    }
}
