/// The greatest whole number that divides both; of 0 and n it is n.
#[must_use]
pub fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
