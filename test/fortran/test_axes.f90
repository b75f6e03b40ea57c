! What lies along x lies along x: every pair of arguments that could be taken for each other, told apart by its answer.
program test_axes
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double
  implicit none
  real(dp), parameter :: pi = acos(-1.0_dp)
  integer :: failures = 0

  call heights()
  call moments()
  call asperities()
  call tips()
  call counts()
  call fortran_77()
  if (failures > 0) error stop 'test_axes'
  print '(a)', 'nothing is taken for something else'

contains

  subroutine check(ok, what)
    logical, intent(in) :: ok
    character(*), intent(in) :: what
    if (ok) return
    failures = failures + 1
    print '(2a)', 'failed: ', what
  end subroutine

  logical function near(a, b)
    real(dp), intent(in) :: a, b
    near = abs(a - b) <= 1e-9_dp * abs(b)
  end function

  ! A map of 7 by 5 points, 0.5 and 0.25 apart, from (-1, 2) on, with one summit at its point (5, 2).
  subroutine heights()
    type(rsc_surface) :: surface
    type(rsc_asperities) :: found
    real(dp) :: z(7, 5), back(7, 5), dx, dy, x0, y0
    real(dp), allocatable :: x(:), y(:), k1(:), k2(:), angle(:)
    integer :: i, j, nx, ny
    logical :: periodic
    do j = 1, 5
      do i = 1, 7
        z(i, j) = -0.5_dp * (3.0_dp * (0.5_dp * (i - 5))**2 + 1.0_dp * (0.25_dp * (j - 2))**2)
      end do
    end do
    call surface%take(z, 0.5_dp, 0.25_dp, -1.0_dp, 2.0_dp, .false.)
    call surface%grid(nx, ny, dx, dy, x0, y0, periodic)
    call check(nx == 7 .and. ny == 5, 'numbers of points')
    call check(near(dx, 0.5_dp) .and. near(dy, 0.25_dp), 'steps')
    call check(near(x0, -1.0_dp) .and. near(y0, 2.0_dp), 'first point')
    call check(.not. periodic, 'not periodic')
    call surface%heights(back)
    call check(all(abs(back - z) < 1e-15_dp), 'heights')
    call found%find(surface)
    call found%get(x, y)
    call check(size(x) == 1, 'one summit')
    call check(near(x(1), 1.0_dp) .and. near(y(1), 2.25_dp), 'place of the summit')
    call found%curvatures(k1, k2, angle)
    call check(near(k1(1), 3.0_dp) .and. near(k2(1), 1.0_dp), 'curvatures')
    call check(near(abs(angle(1)), pi / 2), 'the long axis lies along y')
    call surface%take(z, 0.5_dp, periodic=.true.)
    call surface%grid(dx=dx, dy=dy, x0=x0, y0=y0, periodic=periodic)
    call check(near(dy, 0.5_dp) .and. abs(x0) + abs(y0) < 1e-15_dp .and. periodic, 'what is left out')
  end subroutine

  ! One wave along x: forward differences give 2 sin(pi dx/L)/dx for its wave number.
  subroutine moments()
    type(rsc_surface) :: surface
    real(dp) :: z(32, 8), m0, m2, m4, k
    integer :: i
    do i = 1, 32
      z(i, :) = 0.1_dp * cos(2 * pi * (i - 1) / 32)
    end do
    call surface%take(z, 0.125_dp, periodic=.true.)
    call surface%moments(m0, m2, m4)
    k = 2 * sin(pi / 32) / 0.125_dp
    call check(near(m0, 0.005_dp), 'm0')
    call check(near(m2, 0.0025_dp * k**2), 'm2: half the mean square gradient')
    call check(near(m4, 0.005_dp * k**4 / 3), 'm4')
  end subroutine

  subroutine asperities()
    type(rsc_asperities) :: given
    type(rsc_contact) :: contact
    type(rsc_case) :: options
    real(dp), parameter :: R = 1e-3_dp, q = 1e4_dp, E = 1e5_dp
    real(dp), allocatable :: x(:), y(:), z(:), radius(:), k1(:), k2(:), angle(:), spot(:), force(:)
    real(dp) :: N, u, two(2), deep(1)
    integer :: told
    call given%take([1.0_dp, 2.0_dp], [3.0_dp, 4.0_dp], [0.5_dp, 0.6_dp], [0.7_dp, 0.8_dp], kappa1=[1.9_dp, 1.8_dp], &
                    kappa2=[1.3_dp, 1.2_dp], angle=[0.3_dp, -0.4_dp], biharmonic=[5.0_dp, 6.0_dp])
    call given%get(x, y, z, radius)
    call check(near(x(2), 2.0_dp) .and. near(y(1), 3.0_dp) .and. near(z(1), 0.5_dp) .and. near(radius(2), 0.8_dp), &
               'x, y, z, radius')
    call given%curvatures(k1, k2, angle)
    call check(near(k1(2), 1.8_dp) .and. near(k2(1), 1.3_dp) .and. near(angle(2), -0.4_dp), 'kappa1, kappa2, angle')
    ! A round summit of wave number q, q^2 = biharmonic/(2/R): its spot reaches q a = pi at u = 4/(R q^2) and grows no more.
    call given%take([0.0_dp], [0.0_dp], [0.0_dp], [R], kappa1=[1 / R], kappa2=[1 / R], &
                    angle=[0.3_dp], biharmonic=[2 * q**2 / R])
    call options%set('asperities%law', "'fourth_order'")
    call contact%create(given, E, 1e6_dp, 0.0_dp, 0.0_dp, options)
    u = 4 / (R * q**2)
    call contact%indent(-1.5_dp * u, N)
    call contact%spots(force=force, radius=spot)
    call check(abs(spot(1) - pi / q) < 1e-6_dp * pi / q, 'the biharmonic is the biharmonic')
    call check(near(force(1), N), 'its force')
    call contact%per_asperity(force=two, stat=told)
    call check(told < 0, 'per_asperity: forces of another size')
    call contact%per_asperity(radius=two, stat=told)
    call check(told < 0, 'per_asperity: radii of another size')
    call contact%per_asperity(penetration=two, stat=told)
    call check(told < 0, 'per_asperity: penetrations of another size')
    call contact%per_asperity(force, spot, deep)
    call check(near(force(1), N) .and. abs(spot(1) - pi / q) < 1e-6_dp * pi / q .and. near(deep(1), 1.5_dp * u), 'per_asperity')
  end subroutine

  subroutine tips()
    type(rsc_asperities) :: given
    type(rsc_contact) :: contact
    real(dp) :: x0, y0, N, w(2)
    call given%take([1.0_dp, 0.0_dp], [0.0_dp, 1.0_dp], [0.1_dp, 0.2_dp], [0.3_dp, 0.3_dp])
    call contact%create(given, 1e5_dp, 5.0_dp, 1.0_dp, 0.0_dp)
    call contact%tip(x0, y0)
    call check(near(x0, 1.0_dp) .and. abs(y0) < 1e-15_dp, 'tip where it was put')
    call check(near(contact%first_touch(), 0.1_dp), 'above the first asperity')
    call contact%move_tip(0.0_dp, 1.0_dp)
    call contact%tip(x0, y0)
    call check(abs(x0) < 1e-15_dp .and. near(y0, 1.0_dp), 'tip where it was moved')
    call check(near(contact%first_touch(), 0.2_dp), 'above the second asperity')
    call contact%indent(0.19_dp, N)
    call contact%deflection([0.0_dp, 3.0_dp], [4.0_dp, 1.0_dp], w)
    call check(w(1) > 0 .and. near(w(1), w(2)), 'equally far from the spot')
    call contact%deflection([0.0_dp, 4.0_dp], [4.0_dp, 0.0_dp], w)
    call check(w(1) > 1.2_dp * w(2), 'nearer along y')
  end subroutine

  ! Numbers of contacts of every kind, no two alike, by the answer and by their names.
  subroutine counts()
    type(rsc_case) :: options
    type(rsc_asperities) :: made
    type(rsc_contact) :: contact
    integer :: all, pairs, large, beyond, edge
    call options%read("&surface n=256, L_lambda_l=4, L_lambda_s=32, sigma=0.02 / &asperities law='fourth_order' /" // &
                      "&indentation centre=0.1, 0.5 /")
    call made%make(options)
    call contact%create_from_case(made, options)
    call contact%indent(-0.01_dp)
    call contact%answer(contacts=all, overlapping_pairs=pairs, large_contacts=large, beyond_law=beyond, edge_contacts=edge)
    call check(all == contact%contacts() .and. all == nint(contact%value('contacts')), 'contacts')
    call check(pairs == nint(contact%value('overlapping_pairs')), 'overlapping_pairs')
    call check(large == nint(contact%value('large_contacts')), 'large_contacts')
    call check(beyond == nint(contact%value('beyond_law')), 'beyond_law')
    call check(edge == nint(contact%value('edge_contacts')), 'edge_contacts')
    call check(all /= pairs .and. all /= large .and. all /= beyond .and. all /= edge .and. pairs /= large .and. &
               pairs /= beyond .and. pairs /= edge .and. large /= beyond .and. large /= edge .and. beyond /= edge, 'no two alike')
    call check(min(pairs, large, beyond, edge) > 0, 'each there')
  end subroutine

  ! The routines of rsc77: the map of heights() again, pressed, and the surface beside its summit.
  subroutine fortran_77()
    external :: rscsur, rscfnd, rscxyz, rscasp, rsccon, rscind, rscdfl, rscdel, rsclev, rsctip, rsctch
    type(rsc_asperities) :: three
    type(rsc_contact) :: of_three
    integer :: surface, found, contact, error, i, j, status, candidates, iterations, overlapping, n(3)
    real(dp) :: z(7, 5), x(1), y(1), height(1), radius(1), force, w(2), residual, touch
    do j = 1, 5
      do i = 1, 7
        z(i, j) = -0.5_dp * (3.0_dp * (0.5_dp * (i - 5))**2 + 1.0_dp * (0.25_dp * (j - 2))**2)
      end do
    end do
    surface = 0
    found = 0
    contact = 0
    call rscsur(surface, 7, 5, 0.5_dp, 0.25_dp, -1.0_dp, 2.0_dp, 0, z, error)
    call check(error == 0, 'rscsur')
    call rscfnd(found, surface, 0, error)
    call rscxyz(found, 1, x, y, height, radius, error)
    call check(error == 0 .and. near(x(1), 1.0_dp) .and. near(y(1), 2.25_dp), 'rscxyz: place of the summit')
    call check(near(radius(1), 1 / sqrt(3.0_dp)), 'rscxyz: radius of the summit')
    call rsccon(contact, found, 1e5_dp, 5.0_dp, 1.0_dp, 2.25_dp, 0, error)
    call rscind(contact, -0.01_dp, force, error)
    call rscdfl(contact, 2, [1.0_dp, 3.0_dp], [2.75_dp, 2.25_dp], w, error)
    call check(error == 0 .and. w(1) > 3 * w(2), 'rscdfl: nearer along y')
    call rsctip(contact, 0.5_dp, 3.0_dp, error)  ! x = 3, y = 0.5 is not above the map
    call rsctch(contact, touch, error)
    call check(error == 0 .and. abs(touch + (0.5_dp**2 + 0.75_dp**2) / 10) < 0.01_dp, 'rsctip: beside the summit')
    ! Three asperities: the numbers are those of the module.
    call three%take([1.0_dp, 1.01_dp, 1.3_dp], [0.0_dp, 0.0_dp, 0.1_dp], [0.0_dp, 0.0_dp, 0.0_dp], [0.3_dp, 0.3_dp, 0.3_dp])
    call of_three%create(three, 1e5_dp, 5.0_dp, 1.0_dp, 0.0_dp)
    call of_three%indent(-0.01_dp)
    call of_three%level(candidates=n(1), iterations=n(2), overlapping_pairs=n(3))
    call rscasp(found, 3, [1.0_dp, 1.01_dp, 1.3_dp], [0.0_dp, 0.0_dp, 0.1_dp], [0.0_dp, 0.0_dp, 0.0_dp], &
                [0.3_dp, 0.3_dp, 0.3_dp], error)
    call rsccon(contact, found, 1e5_dp, 5.0_dp, 1.0_dp, 0.0_dp, 0, error)
    call rscind(contact, -0.01_dp, force, error)
    call rsclev(contact, status, candidates, iterations, overlapping, residual, error)
    call check(error == 0 .and. all([candidates, iterations, overlapping] == n), 'rsclev')
    call check(n(2) /= n(3) .and. n(1) /= n(3), 'rsclev: not alike')
    call rscdel(contact, error)
    call rscdel(found, error)
    call rscdel(surface, error)
  end subroutine
end program
