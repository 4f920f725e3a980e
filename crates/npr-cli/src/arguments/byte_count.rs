//! Parses amounts of memory.

/// Parses a number of bytes such as `512M`; K, M and G are powers of 1024.
pub fn byte_count(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor: u64 = match text[digits.len()..].to_ascii_uppercase().as_str() {
        "" | "B" => 1,
        "K" | "KB" | "KIB" => 1 << 10,
        "M" | "MB" | "MIB" => 1 << 20,
        "G" | "GB" | "GIB" => 1 << 30,
        _ => {
            return Err("must be a number of bytes, with K, M or G after it or nothing".to_owned());
        }
    };
    let count: u64 = digits
        .parse()
        .map_err(|_| "must start with a whole number".to_owned())?;
    count
        .checked_mul(factor)
        .ok_or_else(|| "is larger than any memory".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suffixes_are_powers_of_1024() {
        assert_eq!(byte_count("300"), Ok(300));
        assert_eq!(byte_count("2k"), Ok(2048));
        assert_eq!(byte_count("3M"), Ok(3 << 20));
        assert_eq!(byte_count("4GiB"), Ok(4 << 30));
    }

    #[test]
    fn nonsense_is_refused() {
        for text in ["", "M", "-1", "1.5G", "1T", "99999999999G", "1é"] {
            assert!(byte_count(text).is_err(), "{text}");
        }
    }
}
