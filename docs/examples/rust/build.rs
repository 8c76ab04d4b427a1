// Asks pkg-config where foam's C library is: PKG_CONFIG_PATH names the folder with foam.pc.
use std::process::Command;

fn main() {
    let asked = Command::new("pkg-config").args(["--variable=libdir", "foam"]).output().expect("pkg-config runs");
    assert!(asked.status.success(), "pkg-config does not know foam; remedy: set PKG_CONFIG_PATH to the folder of foam.pc");
    let folder = String::from_utf8(asked.stdout).expect("a path");
    println!("cargo:rustc-link-search=native={}", folder.trim());
    println!("cargo:rustc-link-lib=dylib=foam-c");
    println!("cargo:rustc-link-arg=-Wl,-rpath,{}", folder.trim());
}
