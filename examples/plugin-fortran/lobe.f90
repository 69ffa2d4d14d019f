! Directions about +z with the density 3 / (2 pi) cos^2 per steradian.
module lobe
  use iso_c_binding
  implicit none
  real(c_double), parameter :: two_pi = 6.28318530717958648_c_double
contains
  integer(c_int32_t) function lobe_sample(self, u, w) bind(c)
    type(c_ptr), value :: self
    real(c_double), intent(in) :: u(2)
    real(c_double), intent(out) :: w(3)
    real(c_double) :: r
    w(3) = (1 - u(1)) ** (1 / 3.0_c_double)
    r = sqrt(max(1 - w(3) ** 2, 0.0_c_double))
    w(1) = r * cos(two_pi * u(2))
    w(2) = r * sin(two_pi * u(2))
    lobe_sample = 1
  end function

  real(c_double) function lobe_pdf(self, w) bind(c)
    type(c_ptr), value :: self
    real(c_double), intent(in) :: w(3)
    lobe_pdf = 3 / two_pi * w(3) ** 2
  end function
end module
