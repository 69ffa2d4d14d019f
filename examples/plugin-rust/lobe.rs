// A sampler for `carlo validate --plugin`: cosine-distributed directions about +z, in Rust without crates.
// plugin.c contains the table of these functions; <mc/check/plugin.h> defines their contract.

const TWO_PI: f64 = 2.0 * std::f64::consts::PI;

/// # Safety
/// u points to two numbers in [0, 1), w to three numbers.
#[no_mangle]
pub unsafe extern "C" fn lobe_sample(_this: *const std::ffi::c_void, u: *const f64, w: *mut f64) -> i32 {
    let (u, w) = unsafe { (std::slice::from_raw_parts(u, 2), std::slice::from_raw_parts_mut(w, 3)) };
    let (r, phi) = (u[0].sqrt(), TWO_PI * u[1]);
    w.copy_from_slice(&[r * phi.cos(), r * phi.sin(), (1.0 - u[0]).sqrt()]);
    1 // MC_POINT
}

/// # Safety
/// w points to three numbers.
#[no_mangle]
pub unsafe extern "C" fn lobe_pdf(_this: *const std::ffi::c_void, w: *const f64) -> f64 {
    let w = unsafe { std::slice::from_raw_parts(w, 3) };
    2.0 * w[2].max(0.0) / TWO_PI
}
