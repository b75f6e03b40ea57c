! The Fortran module: values against closed forms, arrays of every kind, failures told and not told, copies, finalisers.
program test_api
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int32_t, c_int64_t
  implicit none
  real(dp), parameter :: pi = acos(-1.0_dp), E = 2.0e5_dp, u = 1.0e-3_dp
  integer :: checks = 0, failures = 0

  call options_by_name()
  call one_asperity()
  call many_asperities()
  call surfaces()
  call friction()
  call misuse()
  call lifetimes()
  print '(i0,a,i0,a)', checks, ' checks, ', failures, ' failed'
  if (failures > 0) error stop 'test_api'

contains

  subroutine check(ok, what)
    logical, intent(in) :: ok
    character(*), intent(in) :: what
    checks = checks + 1
    if (ok) return
    failures = failures + 1
    print '(2a)', 'failed: ', what
  end subroutine

  subroutine close_to(a, b, relative, what)
    real(dp), intent(in) :: a, b, relative
    character(*), intent(in) :: what
    call check(abs(a - b) <= relative * abs(b), what)
  end subroutine

  subroutine options_by_name()
    type(rsc_case) :: options, other
    character(200) :: errmsg
    integer :: stat
    call options%set('surface%sigma', 0.02_dp)
    call options%set('surface%n', 4096)
    call options%set('surface%plateau', .true.)
    call options%set('solver%method', "'direct'")
    call check(options%get('surface%sigma') == '0.02', 'real by name')
    call check(options%get('Surface%N ') == '4096', 'integer by name')
    call check(options%get('surface%plateau') == '.true.', 'logical by name')
    call check(options%get('solver%method') == "'direct'", 'text by name')
    call other%read(options%text())
    call check(other%text() == options%text(), 'case as text and back')
    call options%set('surface%sigma', 0.1)
    call check(options%get('surface%sigma') == '0.1', 'default real by name, as written')
    call options%set('run%seed', 9000000000_c_int64_t)
    call check(options%get('run%seed') == '9000000000', 'long integer by name')
    call options%set('solids%E', [1.0e5_dp, 2.0e5_dp])
    call check(options%get('solids%E') == '1e+05, 2e+05', 'array by name')
    call options%set('solids%nu', [0.3, 0.25])
    call check(options%get('solids%nu') == '0.3, 0.25', 'default real array by name')
    call options%set('indentation%levels', [3, 2, 1])
    call check(options%get('indentation%levels') == '3.0, 2.0, 1.0', 'integer array by name')
    call options%set('solids%E', 1.0_dp, stat, errmsg)
    call check(stat < 0 .and. index(errmsg, 'solids%E(1)') > 0, 'one value for two')
    call options%set('solids%E(1)', 1.0_dp / 3)  ! every bit of it
    other = options
    call options%set('solids%E(1)', 2.0_dp)
    call check(other%get('solids%E(1)') == '0.3333333333333333', 'an assigned case is a copy')
    errmsg = 'untouched'
    call options%set('surface%n', 128, stat, errmsg)
    call check(stat == 0 .and. errmsg == 'untouched', 'errmsg keeps its value without failure')
    call options%set('surface%simga', 1, stat, errmsg)
    call check(stat < 0 .and. index(errmsg, 'sigma') > 0, 'unknown name')
    call options%read('&surface n = 64 /', stat)
    call check(stat < 0 .and. options%get('surface%n') == '128', 'a refused text changes nothing')
    call check(index(rsc_library_version(), '.') > 0, 'version')
  end subroutine

  subroutine one_asperity()
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact
    type(rsc_case) :: options
    real(dp) :: N, f, Z, w(2), dN, A, W_, F_x, F_y
    integer :: large, stat
    real(dp), allocatable :: force(:), radius(:), penetration(:)
    integer, allocatable :: which(:)
    integer :: level_status, candidates
    call options%set('solver%tolerance', 1.0e-11_dp)
    call asperities%take([0.0_dp], [0.0_dp], [0.0_dp], [0.3_dp])
    call contact%create(asperities, E, 5.0_dp, 0.0_dp, 0.0_dp, options)
    call contact%indent(-u, N)
    f = 4.0_dp / 3 * E * sqrt(0.3_dp) * u**1.5_dp
    call close_to(N, f, 1e-13_dp, 'force of Hertz')
    call close_to(contact%force(), f, 1e-13_dp, 'force read back')
    call close_to(contact%area(), pi * 0.3_dp * u, 1e-13_dp, 'area of Hertz')
    call close_to(contact%stiffness(), -2 * E * sqrt(0.3_dp * u), 1e-12_dp, 'stiffness of Hertz')
    call close_to(contact%energy(), 0.4_dp * f * u, 1e-12_dp, 'energy of Hertz')
    call check(contact%contacts() == 1 .and. contact%separation() >= -u .and. contact%separation() <= -u, 'level read back')
    call contact%spots(which, force, radius, penetration)
    call check(size(which) == 1 .and. which(1) == 1, 'asperities count from 1')
    call close_to(penetration(1), u, 1e-12_dp, 'penetration')
    call close_to(radius(1)**2, 0.3_dp * u, 1e-12_dp, 'radius')
    call contact%deflection([0.0_dp, 3.0_dp], [0.0_dp, 4.0_dp], w)
    call close_to(w(1), u, 1e-12_dp, 'deflection at the summit')
    call close_to(w(2), f / (pi * E * 5) * (1 + 0.3_dp * u / 250), 1e-11_dp, 'deflection far away')
    call contact%level(level_status, candidates)
    call check(level_status == rsc_level_converged .and. candidates == 1, 'level status')
    call contact%answer(Z, N, dN, A, W_, F_x, F_y, level_status, candidates, large_contacts=large)
    call check(Z >= -u .and. Z <= -u .and. N >= contact%force() .and. N <= contact%force(), 'answer: Z0, N')
    call close_to(dN, contact%stiffness(), 1e-15_dp, 'answer: dN/dZ0')
    call close_to(A, contact%area(), 1e-15_dp, 'answer: A')
    call close_to(W_, contact%energy(), 1e-15_dp, 'answer: W')
    call check(abs(F_x) <= 0 .and. abs(F_y) <= 0 .and. level_status == 0 .and. candidates == 1 .and. large == 0, 'answer: the rest')
    call close_to(contact%value('force'), N, 1e-15_dp, 'value by name')
    call check(abs(contact%value('nothing', stat)) <= 0 .and. stat < 0, 'value of no name')
    call contact%move_tip(0.1_dp, 0.0_dp)
    call contact%indent(-0.01_dp, N)
    call contact%answer(lateral_x=F_x, lateral_y=F_y)
    call close_to(F_x, N * 0.1_dp / sqrt(25 - 0.01_dp), 1e-12_dp, 'answer: lateral force')
    call contact%move_tip(0.0_dp, 0.0_dp)
    call contact%press(f, Z)
    call close_to(Z, -u, 1e-9_dp, 'separation under a force')
    call contact%move_tip(0.05_dp, 0.0_dp)
    call close_to(contact%first_touch(), sqrt(25 - 0.05_dp**2) - 5, 1e-9_dp, 'first touch beside the summit')
  end subroutine

  ! Sections that are not contiguous; the sum rule; a copy works on its own.
  subroutine many_asperities()
    integer, parameter :: n = 400
    real(dp) :: xyzr(4, n), force(n), radius(n), d(n), x(1), w(1)
    real(dp), allocatable :: got(:), f(:)
    integer, allocatable :: which(:)
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact, other
    integer :: i
    do i = 1, n
      xyzr(1, i) = mod(i - 1, 20) * 0.05_dp
      xyzr(2, i) = ((i - 1) / 20) * 0.05_dp
      xyzr(3, i) = 0.01_dp * sin(12.3_dp * i)
      xyzr(4, i) = 0.003_dp * (1 + 0.5_dp * cos(3.1_dp * i))
    end do
    call asperities%take(xyzr(1, :), xyzr(2, :), xyzr(3, :), xyzr(4, :))
    call check(asperities%count() == n, 'count')
    call asperities%get(radius=got)
    call check(all(got >= xyzr(4, :)) .and. all(got <= xyzr(4, :)), 'radii read back')
    call contact%create(asperities, 9.0e4_dp, 20.0_dp, 0.475_dp, 0.475_dp)
    call contact%indent(0.0_dp)
    call contact%per_asperity(force=force, radius=radius)
    call close_to(sum(force), contact%force(), 1e-12_dp, 'forces add up')
    call close_to(pi * sum(radius**2), contact%area(), 1e-12_dp, 'areas add up')
    call contact%spots(which, f)
    call check(size(which) == count(force > 0) .and. all(f >= force(which)) .and. all(f <= force(which)), 'both kinds of arrays')
    x = [2.0_dp]
    call contact%deflection(x, x, w)
    d = sqrt((xyzr(1, :) - 2)**2 + (xyzr(2, :) - 2)**2)
    call close_to(w(1), sum(force / d * (1 + radius**2 / (10 * d**2))) / (pi * 9.0e4_dp), 1e-11_dp, 'deflection')
    other = contact
    call other%indent(0.0_dp)
    call close_to(other%force(), contact%force(), 1e-9_dp, 'a copied contact')
  end subroutine

  subroutine surfaces()
    type(rsc_case) :: options
    type(rsc_surface) :: surface, other
    type(rsc_asperities) :: found, made
    type(rsc_contact) :: contact
    real(dp), allocatable :: z(:,:), a(:), b(:), k1(:), k2(:)
    real(dp) :: m0, dx, N, rms
    integer :: nx, ny
    logical :: periodic
    call options%set('surface%n', 128)
    call options%set('surface%L_lambda_l', 4.0_dp)
    call options%set('surface%L_lambda_s', 32.0_dp)
    call surface%synthesize(options, realization=2)
    call surface%grid(nx, ny, dx, periodic=periodic)
    call check(nx == 128 .and. ny == 128 .and. periodic, 'grid')
    allocate (z(nx, ny))
    call surface%heights(z)
    call surface%moments(m0)
    call close_to(sqrt(m0), 0.01_dp, 1e-10_dp, 'rms height')
    call found%find(surface, options)
    call made%make(options, realization=2)
    call found%get(z=a)
    call made%get(z=b)
    call check(size(a) == size(b) .and. size(a) > 100, 'asperities')
    call check(all(a >= b .and. a <= b), 'found and made are the same')
    call found%curvatures(k1, k2)
    call check(all(k1 >= k2 .and. k2 > 0), 'curvatures')
    ! z(i,j): the first index is x. A ridge along y has its rows equal.
    other = surface
    call surface%take(reshape([1, 2, 3, 1, 2, 3, 1, 2, 3] * 1.0_dp, [3, 3]), dx)
    call surface%heights(z(:3, :3))
    call check(all(abs(z(2, :3) - 2) < 1e-15_dp), 'x is the first index')
    call surface%detrend('plane', rms)
    call check(rms < 1e-12_dp, 'a plane is taken away')
    call other%grid(nx)
    call check(nx == 128, 'an assigned surface is a copy')
    call contact%create_from_case(found, options)
    call contact%indent(0.02_dp, N)
    call check(N > 0, 'contact from a case')
  end subroutine

  ! Mindlin's sphere: first loading, full slip, the path of a copy, spots; failures told.
  subroutine friction()
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact
    type(rsc_friction) :: path, other, again
    type(rsc_contact) :: kept(2)
    real(dp) :: places(2), forces(2)
    integer(c_int32_t) :: each(2)
    integer :: unit
    real(dp), parameter :: r = 2.0e-3_dp, mu = 0.3_dp, z = 0.01_dp
    real(dp) :: N, Q(2), m, slide, most, force(3), stick(3), k(2, 2), lost, energies(2), before
    real(dp), allocatable :: radius(:), inner(:), share(:)
    integer, allocatable :: which(:)
    integer :: stat
    character(100) :: errmsg
    m = rsc_stiffness_ratio([E, E], [0.2_dp, 0.2_dp])
    call close_to(m, 2 * (1 - 0.2_dp) / (2 - 0.2_dp), 1e-14_dp, 'ratio of like bodies')
    call asperities%take([0.5_dp], [0.5_dp], [z], [r])
    call contact%create(asperities, E_star=E, R=2.5_dp, x0=0.5_dp, y0=0.5_dp)
    call path%create(contact, mu, m)
    call path%full_slip(slide, stat=stat)
    call check(stat == rsc_no_result, 'no path yet')
    call path%update(z - u, 0.0_dp, 0.0_dp, force=N)
    call close_to(N, 4 / 3.0_dp * E * sqrt(r) * u**1.5_dp, 1e-10_dp, 'Hertz')
    call path%full_slip(slide, most)
    call close_to(slide, mu / m * u, 1e-10_dp, 'full slip')
    call close_to(most, mu * N, 1e-12_dp, 'most')
    call path%first_loading([0.0_dp, 0.5_dp, 2.0_dp] * slide, force, stick)
    call close_to(force(2), mu * N * (1 - 0.5_dp**1.5_dp), 1e-9_dp, 'Mindlin')
    call close_to(force(3), mu * N, 1e-12_dp, 'slipping')
    call close_to(path%slide(force(2)), 0.5_dp * slide, 1e-7_dp, 'slide at a force')
    call path%commit()
    call path%update(z - u, 0.3_dp * slide, 0.4_dp * slide, force_x=Q(1), force_y=Q(2), lost=lost)
    call close_to(Q(1), 0.6_dp * force(2), 1e-9_dp, 'force along x')
    call close_to(Q(2), 0.8_dp * force(2), 1e-9_dp, 'force along y')
    k = path%stiffness()
    call close_to(0.6_dp * k(1, 1) + 0.8_dp * k(1, 2), 0.6_dp * m * 2 * E * sqrt(r * u / 2), 1e-5_dp, 'stiffness along the slide')
    call path%spots(which, radius, inner, share)
    call check(size(which) == 1 .and. which(1) == 1, 'one spot')
    call close_to(inner(1), radius(1) * sqrt(0.5_dp), 1e-6_dp, 'stick radius')
    call close_to(share(1), Q(1), 1e-9_dp, 'its share')
    other = path
    call other%update(z - u, 0.0_dp, 0.0_dp)
    call path%state(force_x=before, energy=energies(1), tangential_energy=energies(2))
    call check(before >= Q(1) .and. before <= Q(1), 'a copy goes its own way')
    call close_to(energies(1), 0.4_dp * N * u, 1e-9_dp, 'energy')
    call check(energies(2) > 0 .and. lost > 0, 'stored and lost')
    call path%save('test_api_friction.kept')
    call again%restore(asperities, 'test_api_friction.kept')
    call again%state(force_x=share(1))
    call path%state(force_x=before)
    call check(share(1) >= before .and. share(1) <= before, 'friction from a file')
    call contact%indent(z - u)
    call contact%save('test_api_friction.kept')
    call kept(2)%restore(asperities, 'test_api_friction.kept')
    call check(kept(2)%force() >= contact%force() .and. kept(2)%force() <= contact%force(), 'contact from a file')
    call again%restore(asperities, 'test_api_friction.kept', stat, errmsg)
    call check(stat == -3 .and. index(errmsg, 'friction') > 0, 'a contact is no friction')
    open (newunit=unit, file='test_api_friction.kept')
    close (unit, status='delete')
    kept(1) = contact
    call rsc_press_all(kept, [N, 2 * N], places, threads=2, each=each)
    call contact%press(2 * N, separation=before)
    call check(places(2) >= before .and. places(2) <= before .and. all(each == 0), 'pressed together')
    call rsc_indent_all(kept, [z, z - u], forces, threads=2, each=each)
    call contact%indent(z - u, force=before)
    call check(forces(2) >= before .and. forces(2) <= before .and. all(each == 0), 'indented together')
    call rsc_indent_all(kept, [z], forces, stat=stat)
    call check(stat == -1 .and. forces(2) >= before .and. forces(2) <= before, 'arrays not of one size')
    call rsc_press_all(kept, [N, -N], places, each=each, stat=stat)
    call check(stat == -2 .and. each(2) == -2 .and. each(1) == 0, 'one of them refused')
    call path%rollback()
    call path%state(force_x=before)
    call check(abs(before) <= 0, 'rolled back')
    call path%create(contact, -mu, m, stat, errmsg)
    call check(stat == -3 .and. index(errmsg, 'mu') > 0, 'negative friction')
    call path%update(0.0_dp, 0.0_dp, 0.0_dp, stat=stat)
    call check(stat == -1, 'nothing created')
    call other%first_loading([1.0_dp, 2.0_dp], force, stat=stat, errmsg=errmsg)
    call check(stat < 0 .and. index(errmsg, 'size') > 0, 'sizes')
  end subroutine

  subroutine misuse()
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact
    type(rsc_surface) :: surface
    real(dp) :: one(1), two(2), square(1, 1), N
    integer :: stat
    character(100) :: errmsg
    one = 1
    two = [1.0_dp, 2.0_dp]
    N = asperities%count(stat)
    call check(stat < 0, 'nothing taken yet')
    call contact%indent(0.0_dp, stat=stat, errmsg=errmsg)
    call check(stat < 0 .and. index(errmsg, 'contact') > 0, 'nothing created yet')
    call contact%create(asperities, 1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, stat=stat)
    call check(stat < 0, 'no asperities')
    call surface%heights(square, stat)
    call check(stat < 0, 'no surface')
    call asperities%take(two, two, two, one, stat=stat, errmsg=errmsg)
    call check(stat < 0 .and. index(errmsg, 'size') > 0, 'sizes')
    call asperities%take([1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], two, two, stat=stat, errmsg=errmsg)
    call check(stat < 0 .and. index(errmsg, 'same place') > 0, 'coincident points')
    call asperities%take(two, two, two, two, kappa1=two, stat=stat)
    call check(stat < 0, 'curvatures go together')
    call asperities%take(one, one, one, -one, stat=stat)
    call check(stat < 0, 'negative radius')
    call asperities%take(one, one, one, one)
    call contact%create(asperities, -1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, stat=stat)
    call check(stat < 0, 'negative modulus')
    call contact%create(asperities, 1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp)
    N = contact%force(stat)
    call check(stat == rsc_no_result, 'no result yet')
    call contact%indent(0.5_dp, N, stat)
    call check(stat == 0 .and. N > 0, 'works after failures')
    call contact%per_asperity(force=two, stat=stat, errmsg=errmsg)
    call check(stat < 0 .and. index(errmsg, 'size') > 0, 'array too long')
    call contact%deflection(two, two, one, stat)
    call check(stat < 0, 'arrays of several sizes')
  end subroutine

  ! Many objects made, made again, and left: a leak or a double release shows under valgrind or AddressSanitizer.
  subroutine lifetimes()
    integer :: k
    do k = 1, 50
      call one_life(k)
    end do
  end subroutine

  subroutine one_life(k)
    integer, intent(in) :: k
    type(rsc_asperities) :: asperities, several(3)
    type(rsc_contact) :: contact
    type(rsc_contact), allocatable :: other
    real(dp) :: N, M
    call asperities%take([1.0_dp * k], [0.0_dp], [0.0_dp], [1.0_dp])
    several = asperities
    call asperities%take([0.0_dp], [0.0_dp], [0.0_dp], [1.0_dp])
    asperities = asperities
    call contact%create(several(2), E, 10.0_dp, 1.0_dp * k, 0.0_dp)
    allocate (other)
    other = contact
    call contact%create(asperities, E, 10.0_dp, 0.0_dp, 0.0_dp)
    call contact%indent(-u, N)
    call other%indent(-u, M)
    call close_to(M, N, 1e-10_dp, 'copies outlive what they came from')
  end subroutine
end program
