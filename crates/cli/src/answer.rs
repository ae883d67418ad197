//! Answers of commands.

/// Result of a command: text for standard output, and the exit code.
pub struct CommandOutput {
    /// Text for standard output.
    pub text: String,
    /// Exit code.
    pub code: u8,
}
