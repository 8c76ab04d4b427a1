//! What this example needs of foam.h, by Rust's ordinary FFI, and a safe function over it.
use std::ffi::{c_void, CStr};
use std::mem::size_of;
use std::os::raw::{c_char, c_int};
use std::ptr::{null, null_mut};

/// foam_options
#[repr(C)]
struct Options {
    size: usize,
    effort: c_int,
    objective: c_int,
    seed: u64,
    time_limit: f64,
    threads: u32,
    reserved: u32,
    poll: Option<extern "C" fn(*mut c_void) -> c_int>,
    user: *mut c_void,
    max_vertices: u32,
    axis_aligned: c_int,
}

/// foam_report
#[repr(C)]
struct Report {
    size: usize,
    spheres: usize,
    volume: f64,
    certified: c_int,
    finished_early: c_int,
    error: [c_char; 512],
}

/// foam_certificate
#[repr(C)]
struct Certificate {
    size: usize,
    holds: c_int,
    solid: c_int,
    cavity: c_int,
    reserved: c_int,
    growth: f64,
    witness: [f64; 3],
}

/// foam_element
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Element {
    pub kind: c_int,
    pub position: [f64; 3],
    pub rotation: [f64; 9],
    pub half: [f64; 3],
    pub radius: f64,
    vertex_count: usize,
    vertices: *const f64,
}

pub const SPHERE: u32 = 1;
pub const CAPSULE: u32 = 2;
pub const BOX: u32 = 8;

#[link(name = "foam-c")]
extern "C" {
    fn foam_region_of_mesh(vertices: *const f64, vertex_count: usize, triangles: *const u32, triangle_count: usize,
                           region: *mut *mut c_void, report: *mut Report) -> c_int;
    fn foam_region_free(region: *mut c_void);
    fn foam_cover(region: *const c_void, count: usize, kinds: u32, options: *const Options,
                  elements: *mut *mut c_void, report: *mut Report) -> c_int;
    fn foam_elements_count(elements: *const c_void) -> usize;
    fn foam_elements_get(elements: *const c_void, index: usize, element: *mut Element) -> c_int;
    fn foam_elements_free(elements: *mut c_void);
    fn foam_certify(region: *const c_void, elements: *const c_void, options: *const Options,
                    certificate: *mut Certificate, report: *mut Report) -> c_int;
    fn foam_version() -> *const c_char;
}

impl Report {
    fn new() -> Self {
        Report { size: size_of::<Report>(), spheres: 0, volume: 0.0, certified: 0, finished_early: 0, error: [0; 512] }
    }

    /// The text of the error, unless the status says that there is none.
    fn check(&self, status: c_int) -> Result<(), String> {
        if status == 0 {
            return Ok(());
        }
        Err(unsafe { CStr::from_ptr(self.error.as_ptr()) }.to_string_lossy().into_owned())
    }
}

/// What is to be covered: a mesh with its search structures.
pub struct Region(*mut c_void);
// The library changes no region after it is made: any number of threads may use it.
unsafe impl Send for Region {}
unsafe impl Sync for Region {}

/// Elements that the library owns.
pub struct Elements(*mut c_void);
unsafe impl Send for Elements {}
unsafe impl Sync for Elements {}

impl Region {
    /// A region of a mesh: metres, three indices a triangle.
    pub fn of_mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, String> {
        let (mut region, mut report) = (null_mut(), Report::new());
        let status = unsafe {
            foam_region_of_mesh(vertices.as_ptr().cast(), vertices.len(), triangles.as_ptr().cast(), triangles.len(),
                                &mut region, &mut report)
        };
        report.check(status).map(|()| Region(region))
    }

    /// At most `count` elements of the kinds, which are a sum, that are proved to cover the region.
    pub fn cover(&self, count: usize, kinds: u32) -> Result<Elements, String> {
        let (mut elements, mut report) = (null_mut(), Report::new());
        let status = unsafe { foam_cover(self.0, count, kinds, null(), &mut elements, &mut report) };
        report.check(status).map(|()| Elements(elements))
    }

    /// Whether the elements are proved to cover the region.
    pub fn is_covered_by(&self, elements: &Elements) -> Result<bool, String> {
        let mut proof = Certificate { size: size_of::<Certificate>(), holds: 0, solid: 0, cavity: 0, reserved: 0,
                                      growth: 0.0, witness: [0.0; 3] };
        let mut report = Report::new();
        let status = unsafe { foam_certify(self.0, elements.0, null(), &mut proof, &mut report) };
        report.check(status).map(|()| proof.holds != 0)
    }
}

impl Drop for Region {
    fn drop(&mut self) {
        unsafe { foam_region_free(self.0) }
    }
}

impl Elements {
    /// A copy of each element. Vertices of hulls would live as long as the elements; this example reads none.
    pub fn all(&self) -> Vec<Element> {
        let none = Element { kind: 0, position: [0.0; 3], rotation: [0.0; 9], half: [0.0; 3], radius: 0.0,
                             vertex_count: 0, vertices: null() };
        let mut found = vec![none; unsafe { foam_elements_count(self.0) }];
        for (index, element) in found.iter_mut().enumerate() {
            unsafe { foam_elements_get(self.0, index, element) };
        }
        found
    }
}

impl Drop for Elements {
    fn drop(&mut self) {
        unsafe { foam_elements_free(self.0) }
    }
}

/// The version of the library.
pub fn version() -> String {
    unsafe { CStr::from_ptr(foam_version()) }.to_string_lossy().into_owned()
}
