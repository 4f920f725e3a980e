//! Interruption.
#![cfg(unix)]

use crate::workplace::Workplace;
use std::process::{Command, Stdio};
use std::time::Duration;

/// How long a run may draw before it is interrupted.
const HEAD_START: Duration = Duration::from_secs(1);

#[test]
fn an_interrupted_run_exits_with_130_and_leaves_nothing() {
    let place = Workplace::with_scene();
    for signal in ["-INT", "-TERM"] {
        let arguments = [
            "render",
            "scene.obj",
            "--size",
            "12000x12000",
            "--backend",
            "cpu",
        ];
        let mut command = place.command(&arguments);
        let mut child = command
            .stderr(Stdio::null())
            .spawn()
            .expect("the command starts");
        std::thread::sleep(HEAD_START);
        let process = child.id().to_string();
        let sent = Command::new("kill")
            .args([signal, &process])
            .status()
            .expect("kill starts");
        assert!(sent.success(), "the run should still draw");
        assert_eq!(child.wait().expect("the command ends").code(), Some(130));
        assert_eq!(place.names(), ["scene.obj"]);
    }
}
