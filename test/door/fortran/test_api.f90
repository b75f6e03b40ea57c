! The Fortran module: what only Fortran has. Values by every type, failures told and not told,
! copies, finalisers.
program test_api
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int32_t, c_int64_t
  implicit none
  real(dp), parameter :: E = 2.0e5_dp, u = 1.0e-3_dp
  integer :: failures = 0

  call options_by_name()
  call lifetimes()

  ! Objects created, created again and released: a leak or a double release shows under valgrind or
  ! AddressSanitizer.
  subroutine lifetimes()
    integer :: k
    do k = 1, 50
      call one_life(k)
    end do
  end subroutine

  subroutine one_life(k)
    integer, intent(in) :: k
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact, other
    real(dp) :: N, M
    call asperities%take([1.0_dp * k], [0.0_dp], [0.0_dp], [1.0_dp])
    call contact%create(asperities, E, 10.0_dp, 1.0_dp * k, 0.0_dp)
    call other%copy(contact)
    call asperities%take([0.0_dp], [0.0_dp], [0.0_dp], [1.0_dp])
    call contact%create(asperities, E, 10.0_dp, 0.0_dp, 0.0_dp)
    call contact%indent(-u, N)
    call asperities%free()
    call asperities%free()
    call other%indent(-u, M)
    call check(abs(M - N) <= 1e-10_dp * N, 'copies outlive what they came from')
    call contact%free()
    call other%free()
  end subroutine

  subroutine given_surface()
    type(rsc_surface) :: surface
    real(dp) :: z(3, 4), back(3, 4), g(4)
    integer :: n(2)
    logical :: periodic
    call random_number(z)
    call surface%take(z, 0.5_dp, dy=2.0_dp, x0=1.0_dp, y0=-3.0_dp, periodic=.true.)
    call surface%grid(n(1), n(2), g(1), g(2), g(3), g(4), periodic)
    call surface%heights(back)
    call check(all(n == [3, 4]) .and. all(abs(g - [0.5_dp, 2.0_dp, 1.0_dp, -3.0_dp]) <= 0) .and. &
               periodic, 'the grid of a surface')
    call check(all(abs(back - z) <= 0), 'its heights')
    call surface%free()
  end subroutine
end program
