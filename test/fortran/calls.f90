! What calls.cpp does, through rsc.f90: the same calls in the same order, every value they give back printed in the same words.
program calls
  use rsc
  use calls_common, only: put, scene, noise, points, oblong_map
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int32_t, c_int64_t
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
  implicit none
  real(dp) :: nan, infinity
  integer :: stat
  character(2000) :: msg
  nan = ieee_value(nan, ieee_quiet_nan)
  infinity = ieee_value(infinity, ieee_positive_inf)
  msg = ''

  scene = 'texts'
  call put('rsc_version.buffer', rsc_library_version())
  call cases()
  call surfaces()
  call synthetic()
  call list()
  call kept()
  call curved()
  call flats()
  call unfinished()
  call many()
  call frictions()
  call sizes()

contains

  ! Success is not told, everything else is; errmsg keeps its value on success.
  subroutine told(function)
    character(*), intent(in) :: function
    character(12) :: code
    write (code, '(i0)') stat
    if (stat /= 0) call put(function // '.code', trim(code) // ' ' // msg)
    if (stat == 0 .and. msg /= '') call put(function // '.code', 'a message without failure: ' // msg)
    msg = ''
    stat = 0
  end subroutine

  ! What is asked for alone is what is told with all the rest.
  subroutine alone(ok, what)
    logical, intent(in) :: ok
    character(*), intent(in) :: what
    call told(what)
    if (.not. ok) call put(what, 'another value where it is asked for alone')
  end subroutine
  elemental logical function same(a, b)
    real(dp), intent(in) :: a, b
    same = a >= b .and. a <= b
  end function

  subroutine read_case(options, text)
    type(rsc_case), intent(inout) :: options
    character(*), intent(in) :: text
    call options%read(text, stat, msg)
    call told('rsc_case_read')
  end subroutine

  subroutine take_list(asperities, bent)
    type(rsc_asperities), intent(inout) :: asperities
    logical, intent(in) :: bent
    real(dp), dimension(35) :: x, y, z, radius, kappa1, kappa2, angle, biharmonic
    integer :: k
    call points(x, y, z, radius)
    do k = 1, 35
      kappa2(k) = 1.5_dp + noise(k, 5)
      kappa1(k) = kappa2(k) + 0.25_dp + noise(k, 6)
      angle(k) = noise(k, 7) - 0.5_dp
      biharmonic(k) = 400 + 256 * noise(k, 8)
    end do
    if (bent) then
      call asperities%take(x, y, z, radius, kappa1, kappa2, angle, biharmonic, stat, msg)
    else
      call asperities%take(x, y, z, radius, stat=stat, errmsg=msg)
    end if
    call told('rsc_asperities_take')
  end subroutine

  subroutine read_asperities(asperities, with_curvatures)
    type(rsc_asperities), intent(in) :: asperities
    logical, intent(in) :: with_curvatures
    real(dp), allocatable :: x(:), y(:), z(:), radius(:), one(:)
    call put('rsc_asperities_count.n', asperities%count(stat, msg))
    call told('rsc_asperities_count')
    call asperities%get(x, y, z, radius, stat, msg)
    call told('rsc_asperities_get')
    call put('rsc_asperities_get.x', x)
    call put('rsc_asperities_get.y', y)
    call put('rsc_asperities_get.z', z)
    call put('rsc_asperities_get.radius', radius)
    call asperities%get(x=one, stat=stat, errmsg=msg)
    call alone(all(same(one, x)), 'rsc_asperities_get')
    call asperities%get(y=one, stat=stat, errmsg=msg)
    call alone(all(same(one, y)), 'rsc_asperities_get')
    call asperities%get(z=one, stat=stat, errmsg=msg)
    call alone(all(same(one, z)), 'rsc_asperities_get')
    call asperities%get(radius=one, stat=stat, errmsg=msg)
    call alone(all(same(one, radius)), 'rsc_asperities_get')
    call asperities%curvatures(x, y, z, stat, msg)
    call told('rsc_asperities_curvatures')
    if (.not. with_curvatures) return
    call put('rsc_asperities_curvatures.kappa1', x)
    call put('rsc_asperities_curvatures.kappa2', y)
    call put('rsc_asperities_curvatures.angle', z)
    call asperities%curvatures(kappa1=one, stat=stat, errmsg=msg)
    call alone(all(same(one, x)), 'rsc_asperities_curvatures')
    call asperities%curvatures(kappa2=one, stat=stat, errmsg=msg)
    call alone(all(same(one, y)), 'rsc_asperities_curvatures')
    call asperities%curvatures(angle=one, stat=stat, errmsg=msg)
    call alone(all(same(one, z)), 'rsc_asperities_curvatures')
  end subroutine

  subroutine read_surface(surface)
    type(rsc_surface), intent(in) :: surface
    integer :: nx, ny, n
    real(dp) :: dx, dy, x0, y0, m0, m2, m4, one
    logical :: periodic, wraps
    real(dp), allocatable :: z(:,:)
    call surface%grid(nx, ny, dx, dy, x0, y0, periodic, stat, msg)
    call told('rsc_surface_grid')
    call put('rsc_surface_grid.nx', nx)
    call put('rsc_surface_grid.ny', ny)
    call put('rsc_surface_grid.dx', dx)
    call put('rsc_surface_grid.dy', dy)
    call put('rsc_surface_grid.x0', x0)
    call put('rsc_surface_grid.y0', y0)
    call put('rsc_surface_grid.periodic', merge(1, 0, periodic))
    call surface%grid(nx=n, stat=stat, errmsg=msg)
    call alone(n == nx, 'rsc_surface_grid')
    call surface%grid(ny=n, stat=stat, errmsg=msg)
    call alone(n == ny, 'rsc_surface_grid')
    call surface%grid(dy=one, stat=stat, errmsg=msg)
    call alone(same(one, dy), 'rsc_surface_grid')
    call surface%grid(x0=one, periodic=wraps, stat=stat, errmsg=msg)
    call alone(same(one, x0) .and. (wraps .eqv. periodic), 'rsc_surface_grid')
    allocate (z(nx, ny))
    call surface%heights(z, stat, msg)
    call told('rsc_surface_heights')
    call put('rsc_surface_heights.heights', [z])
    call surface%moments(m0, m2, m4, stat, msg)
    call told('rsc_surface_moments')
    call put('rsc_surface_moments.m0', m0)
    call put('rsc_surface_moments.m2', m2)
    call put('rsc_surface_moments.m4', m4)
    call surface%moments(m4=one, stat=stat, errmsg=msg)
    call alone(same(one, m4), 'rsc_surface_moments')
  end subroutine

  subroutine tip(contact)
    type(rsc_contact), intent(in) :: contact
    real(dp) :: x0, y0, one
    call contact%tip(x0, y0, stat, msg)
    call told('rsc_contact_tip')
    call put('rsc_contact_tip.x0', x0)
    call put('rsc_contact_tip.y0', y0)
    call contact%tip(y0=one, stat=stat, errmsg=msg)
    call alone(same(one, y0), 'rsc_contact_tip')
    call put('rsc_contact_first_touch.separation', contact%first_touch(stat, msg))
    call told('rsc_contact_first_touch')
  end subroutine

  subroutine read_contact(contact, elements)
    type(rsc_contact), intent(inout) :: contact
    logical, intent(in) :: elements
    real(dp) :: Z, N, A, residual, dN, W, fx, fy, deflection(3), one, all_f(35), all_r(35), all_u(35), some(35)
    integer :: candidates, iterations, pairs, large, beyond, edge, status, contacts, k
    integer, allocatable :: which(:), whom(:)
    real(dp), allocatable :: force(:), radius(:), penetration(:), values(:)
    character(12), parameter :: names(4) = [character(12) :: 'moment_x', 'moment_y', 'nominal_area', 'products']
    call put('rsc_contact_result.separation', contact%separation(stat, msg))
    call told('rsc_contact_result')
    call put('rsc_contact_result.force', contact%force(stat, msg))
    call told('rsc_contact_result')
    call put('rsc_contact_result.area', contact%area(stat, msg))
    call told('rsc_contact_result')
    call put('rsc_contact_result.contacts', contact%contacts(stat, msg))
    call told('rsc_contact_result')
    call contact%level(status, candidates, iterations, pairs, residual, stat, msg)
    call told('rsc_contact_level')
    call put('rsc_contact_level.level_status', status)
    call put('rsc_contact_level.candidates', candidates)
    call put('rsc_contact_level.iterations', iterations)
    call put('rsc_contact_level.overlapping_pairs', pairs)
    call put('rsc_contact_level.residual', residual)
    call contact%level(residual=one, overlapping_pairs=k, stat=stat, errmsg=msg)
    call alone(same(one, residual) .and. k == pairs, 'rsc_contact_level')
    call put('rsc_contact_stiffness.stiffness', contact%stiffness(stat, msg))
    call told('rsc_contact_stiffness')
    call put('rsc_contact_energy.energy', contact%energy(stat, msg))
    call told('rsc_contact_energy')
    call contact%answer(Z, N, dN, A, W, fx, fy, status, contacts, pairs, large, beyond, edge, stat, msg)
    call told('rsc_contact_answer')
    call put('rsc_contact_answer.separation', Z)
    call put('rsc_contact_answer.force', N)
    call put('rsc_contact_answer.stiffness', dN)
    call put('rsc_contact_answer.area', A)
    call put('rsc_contact_answer.energy', W)
    call put('rsc_contact_answer.lateral_x', fx)
    call put('rsc_contact_answer.lateral_y', fy)
    call put('rsc_contact_answer.level_status', status)
    call put('rsc_contact_answer.contacts', contacts)
    call put('rsc_contact_answer.overlapping_pairs', pairs)
    call put('rsc_contact_answer.large_contacts', large)
    call put('rsc_contact_answer.beyond_law', beyond)
    call put('rsc_contact_answer.edge_contacts', edge)
    call contact%answer(stiffness=one, edge_contacts=k, stat=stat, errmsg=msg)
    call alone(same(one, dN) .and. k == edge, 'rsc_contact_answer')
    do k = 1, 4
      call put('rsc_contact_value.value', contact%value(names(k), stat, msg))
      call told('rsc_contact_value')
    end do
    call contact%spots(which, force, radius, penetration, stat, msg)
    call told('rsc_contact_spots')
    call put('rsc_contact_spots.asperity', which - 1)
    call put('rsc_contact_spots.force', force)
    call put('rsc_contact_spots.radius', radius)
    call put('rsc_contact_spots.penetration', penetration)
    call contact%spots(asperity=whom, stat=stat, errmsg=msg)
    call alone(all(whom == which), 'rsc_contact_spots')
    call contact%spots(force=values, stat=stat, errmsg=msg)
    call alone(all(same(values, force)), 'rsc_contact_spots')
    call contact%spots(radius=values, stat=stat, errmsg=msg)
    call alone(all(same(values, radius)), 'rsc_contact_spots')
    call contact%spots(penetration=values, stat=stat, errmsg=msg)
    call alone(all(same(values, penetration)), 'rsc_contact_spots')
    if (.not. elements) then
      call contact%per_asperity(all_f, all_r, all_u, stat, msg)
      call told('rsc_contact_per_asperity')
      call put('rsc_contact_per_asperity.force', all_f)
      call put('rsc_contact_per_asperity.radius', all_r)
      call put('rsc_contact_per_asperity.penetration', all_u)
      call contact%per_asperity(penetration=some, stat=stat, errmsg=msg)
      call alone(all(same(some, all_u)), 'rsc_contact_per_asperity')
    end if
    call contact%deflection([0.25_dp, 0.375_dp, 0.75_dp], [1.25_dp, 0.875_dp, 1.0_dp], deflection, stat, msg)
    call told('rsc_contact_deflection')
    call put('rsc_contact_deflection.deflection', deflection)
  end subroutine

  subroutine indent(contact, separation)
    type(rsc_contact), intent(inout) :: contact
    real(dp), intent(in) :: separation
    real(dp) :: force
    call contact%indent(separation, force, stat, msg)
    call told('rsc_contact_indent')
    call put('rsc_contact_indent.force', force)
  end subroutine

  subroutine press(contact, force)
    type(rsc_contact), intent(inout) :: contact
    real(dp), intent(in) :: force
    real(dp) :: separation
    call contact%press(force, separation, stat, msg)
    call told('rsc_contact_press')
    call put('rsc_contact_press.separation', separation)
  end subroutine

  subroutine get(options, name)
    type(rsc_case), intent(in) :: options
    character(*), intent(in) :: name
    call told('rsc_case_set')
    call put('rsc_case_get.buffer', options%get(name, stat, msg))
    call told('rsc_case_get')
  end subroutine

  subroutine whole(options)
    type(rsc_case), intent(in) :: options
    call put('rsc_case_text.buffer', options%text(stat, msg))
    call told('rsc_case_text')
  end subroutine

  subroutine cases()
    type(rsc_case) :: options, other
    integer :: failed
    scene = 'cases'
    call options%set('surface%sigma', 0.1_dp + 0.2_dp, stat, msg)
    call get(options, 'surface%sigma')
    call options%set('surface%hurst', 0.1, stat, msg)
    call get(options, 'surface%hurst')
    call options%set('surface%n', 4096, stat, msg)
    call get(options, 'surface%n')
    call options%set('run%seed', 9000000000_c_int64_t, stat, msg)
    call get(options, 'run%seed')
    call options%set('surface%plateau', .true., stat, msg)
    call get(options, 'surface%plateau')
    call options%set('solids%E', [0.1_dp, 0.7_dp], stat, msg)
    call get(options, 'solids%E')
    call options%set('solids%nu', [0.1, 0.3], stat, msg)
    call get(options, 'solids%nu')
    call options%set('indentation%levels', [3, 2, 1], stat, msg)
    call get(options, 'indentation%levels')
    call options%set('solver%method', "'direct'", stat, msg)
    call get(options, 'solver%method')
    call options%set('run%title', "'it''s'", stat, msg)
    call get(options, 'run%title')
    call options%set('indentation%centre(2)', 0.625_dp, stat, msg)
    call get(options, 'indentation%centre(2)')
    call options%set('output%heights', .false., stat, msg)
    call get(options, 'output%heights')
    call options%set('surface%file', "'" // repeat('f', 4096) // "'", stat, msg)
    call get(options, 'surface%file')
    call whole(options)
    other = options
    call options%set('surface%sigma', 0.03125_dp, stat, msg)
    call get(other, 'surface%sigma')
    call options%set('surface%simga', 1, stat, msg)
    call told('rsc_case_set')
    call options%set('surface%sigma', -1, stat, msg)
    call told('rsc_case_set')
    if (options%get('surface%simga', stat, msg) /= '') call put('rsc_case_get', 'a value after a failure')
    call told('rsc_case_get')
    call options%read('&surface n=3 /', stat, msg)
    call told('rsc_case_read')
    call options%read_file('no/such/file.nml', stat, msg)
    call told('rsc_case_read_file')
    call get(options, 'surface%sigma')
    call options%read('&surface n=128, L_lambda_l=4, L_lambda_s=32, sigma=0.25 / &solids nu=0.1, 0.2 /', stat, msg)
    call told('rsc_case_read')
    call whole(options)
    call other%read_file('calls.nml', stat, msg)
    call told('rsc_case_read_file')
    call whole(other)
    call other%run(failed, stat, msg)
    call told('rsc_case_run')
    call put('rsc_case_run.failed_levels', failed)
    call other%set('surface%n', 16, stat, msg)
    call told('rsc_case_set')
    call other%run(stat=stat, errmsg=msg)
    call told('rsc_case_run')
  end subroutine

  subroutine surfaces()
    type(rsc_case) :: options
    type(rsc_surface) :: surface, other
    type(rsc_asperities) :: found
    real(dp) :: z(9, 7), rms
    character(9), parameter :: forms(6) = [character(9) :: 'none', 'mean', 'plane', 'quadratic', 'sphere', 'cubic']
    integer :: k
    scene = 'surfaces'
    z = oblong_map()
    call read_case(options, "&asperities curvature='algebraic' /")
    do k = 1, 0, -1
      call surface%take(z, 0.125_dp, 0.1875_dp, -0.5_dp, 0.75_dp, k == 1, stat, msg)
      call told('rsc_surface_take')
      call read_surface(surface)
      call found%find(surface, stat=stat, errmsg=msg)
      call told('rsc_asperities_find')
      call read_asperities(found, .true.)
      call found%find(surface, options, stat, msg)
      call told('rsc_asperities_find')
      call read_asperities(found, .true.)
    end do
    other = surface
    scene = 'forms'
    do k = 1, 6
      call surface%detrend(forms(k), rms, stat, msg)
      call told('rsc_surface_detrend')
      if (k < 6) call put('rsc_surface_detrend.rms', rms)
    end do
    call read_surface(surface)
    call surface%filter(0.3125_dp, stat, msg)
    call told('rsc_surface_filter')
    call surface%filter(-1.0_dp, stat, msg)
    call told('rsc_surface_filter')
    call read_surface(surface)
    call read_surface(other)
    scene = 'surfaces'
    call surface%take(z, 0.0_dp, 0.1875_dp, -0.5_dp, 0.75_dp, stat=stat, errmsg=msg)
    call told('rsc_surface_take')
    call surface%take(z, 0.125_dp, -1.0_dp, -0.5_dp, 0.75_dp, stat=stat, errmsg=msg)
    call told('rsc_surface_take')
    call surface%take(z, 0.125_dp, 0.1875_dp, nan, 0.75_dp, stat=stat, errmsg=msg)
    call told('rsc_surface_take')
    call surface%take(z, 0.125_dp, 0.1875_dp, -0.5_dp, infinity, stat=stat, errmsg=msg)
    call told('rsc_surface_take')
    z(6, 1) = nan
    call surface%take(z, 0.125_dp, 0.1875_dp, -0.5_dp, 0.75_dp, stat=stat, errmsg=msg)
    call told('rsc_surface_take')
  end subroutine

  subroutine synthetic()
    type(rsc_case) :: options
    type(rsc_surface) :: surface
    type(rsc_asperities) :: made, other
    type(rsc_contact) :: contact
    integer :: k
    scene = 'synthetic'
    call read_case(options, '&surface n=64, L=1.5, L_lambda_l=2, L_lambda_s=8, sigma=0.03125 / &run seed=5 / ' // &
                   '&solids E=1e3, 3e3  nu=0.125, 0.375  R=3.0, 5.0  resistivity=1e-5, 3e-5 / &indentation centre=0.625, 0.875 /')
    do k = 3, 1, -2
      if (k == 3) call surface%synthesize(options, k, stat, msg)
      if (k == 1) call surface%synthesize(options, stat=stat, errmsg=msg)  ! the first is the one that is not named
      call told('rsc_surface_synthesize')
      call read_surface(surface)
      if (k == 3) call made%make(options, k, stat, msg)
      if (k == 1) call made%make(options, stat=stat, errmsg=msg)
      call told('rsc_asperities_make')
      call read_asperities(made, .true.)
    end do
    other = made
    call read_asperities(other, .true.)
    call contact%create_from_case(other, options, stat, msg)
    call told('rsc_contact_create_from_case')
    call tip(contact)
    call indent(contact, 0.03125_dp)
    call read_contact(contact, .true.)
    call put('rsc_contact_value.value', contact%value('resistance', stat, msg))
    call told('rsc_contact_value')
    call options%set('surface%n', 16, stat, msg)
    call told('rsc_case_set')
    call surface%synthesize(options, 1, stat, msg)
    call told('rsc_surface_synthesize')
    call made%make(options, 1, stat, msg)
    call told('rsc_asperities_make')
    call options%set('solver%model', "'elements'", stat, msg)
    call told('rsc_case_set')
    call contact%create_from_case(other, options, stat, msg)
    call told('rsc_contact_create_from_case')
  end subroutine

  subroutine list()
    type(rsc_case) :: options
    type(rsc_asperities) :: asperities, again
    type(rsc_contact) :: contact, other
    real(dp) :: w(2), one(1), two(1), zero(1), value
    scene = 'list'
    call read_case(options, '&solver tolerance=1e-9 / &surface L=4.0 /')
    call take_list(asperities, .false.)
    call read_asperities(asperities, .false.)
    call contact%create(asperities, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, options, stat, msg)
    call told('rsc_contact_create')
    call tip(contact)
    value = contact%force(stat, msg)
    call told('rsc_contact_result')
    call contact%press(-1.0_dp, stat=stat, errmsg=msg)
    call told('rsc_contact_press')
    call indent(contact, 0.0_dp)
    call read_contact(contact, .false.)
    call press(contact, 8.0_dp)
    call read_contact(contact, .false.)
    call contact%move_tip(0.5_dp, 0.9375_dp, stat, msg)
    call told('rsc_contact_move_tip')
    call tip(contact)
    call read_contact(contact, .false.)
    other = contact
    call tip(other)
    value = other%energy(stat, msg)
    call told('rsc_contact_energy')
    call indent(contact, -0.015625_dp)
    call read_contact(contact, .false.)
    call indent(other, -0.015625_dp)
    call read_contact(other, .false.)
    call contact%indent(nan, stat=stat, errmsg=msg)
    call told('rsc_contact_indent')
    call contact%press(-1.0_dp, stat=stat, errmsg=msg)
    call told('rsc_contact_press')
    call contact%move_tip(1e3_dp, 1.0_dp, stat, msg)
    call told('rsc_contact_move_tip')
    call contact%move_tip(nan, 1.0_dp, stat, msg)
    call told('rsc_contact_move_tip')
    call contact%move_tip(1.0_dp, infinity, stat, msg)
    call told('rsc_contact_move_tip')
    call contact%deflection([0.25_dp, nan], [0.5_dp, 0.75_dp], w, stat, msg)
    call told('rsc_contact_deflection')
    call contact%deflection([0.5_dp, 0.75_dp], [0.25_dp, nan], w, stat, msg)
    call told('rsc_contact_deflection')
    value = contact%value('nothing', stat, msg)
    call told('rsc_contact_value')
    call tip(contact)
    call read_contact(contact, .false.)
    call contact%create(asperities, -1.0_dp, 4.0_dp, 0.5_dp, 1.0_dp, options, stat, msg)
    call told('rsc_contact_create')
    call contact%create(asperities, 3e3_dp, 0.0_dp, 0.5_dp, 1.0_dp, options, stat, msg)
    call told('rsc_contact_create')
    call contact%create(asperities, 3e3_dp, 4.0_dp, nan, 1.0_dp, options, stat, msg)
    call told('rsc_contact_create')
    call contact%create(asperities, 3e3_dp, 4.0_dp, 0.5_dp, nan, options, stat, msg)
    call told('rsc_contact_create')
    call options%set('solver%model', "'elements'", stat, msg)
    call told('rsc_case_set')
    call contact%create(asperities, 3e3_dp, 4.0_dp, 0.5_dp, 1.0_dp, options, stat, msg)
    call told('rsc_contact_create')
    one = 1
    two = 0.5_dp
    zero = 0
    call again%take(one, two, zero, zero, stat=stat, errmsg=msg)
    call told('rsc_asperities_take')
    call again%take([1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], stat=stat, errmsg=msg)
    call told('rsc_asperities_take')
  end subroutine

  subroutine kept()
    type(rsc_asperities) :: asperities, again
    type(rsc_contact) :: contact
    scene = 'kept'
    call take_list(asperities, .false.)
    call take_list(again, .true.)
    call contact%create(asperities, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, stat=stat, errmsg=msg)
    call told('rsc_contact_create')
    call indent(contact, 0.0_dp)
    call contact%move_tip(0.5_dp, 0.9375_dp, stat, msg)
    call told('rsc_contact_move_tip')
    call contact%save('contact.kept', stat, msg)
    call told('rsc_contact_save')
    call contact%restore(asperities, 'contact.kept', stat, msg)
    call told('rsc_contact_restore')
    call tip(contact)
    call read_contact(contact, .false.)
    call indent(contact, -0.015625_dp)
    call read_contact(contact, .false.)
    call contact%save('no/folder/contact.kept', stat, msg)
    call told('rsc_contact_save')
    call contact%restore(asperities, 'nothing.kept', stat, msg)
    call told('rsc_contact_restore')
    call contact%restore(again, 'contact.kept', stat, msg)
    call told('rsc_contact_restore')
  end subroutine

  subroutine curved()
    type(rsc_case) :: options, bent, soft
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact
    type(rsc_friction) :: friction
    real(dp) :: one(1), two(1), zero(1)
    real(dp), parameter :: separations(3) = [0.015625_dp, 0.0_dp, 0.0078125_dp]
    integer :: k
    scene = 'curved'
    one = 1
    two = 0.5_dp
    zero = 0
    call asperities%take(one, two, zero, one, two, one, zero, stat=stat, errmsg=msg)
    call told('rsc_asperities_take')
    call asperities%take(one, two, zero, one, one, zero, zero, stat=stat, errmsg=msg)
    call told('rsc_asperities_take')
    call asperities%take(one, two, zero, one, kappa1=one, angle=zero, stat=stat, errmsg=msg)
    call told('rsc_asperities_take')
    call read_case(options, "&asperities law='fourth_order' / &surface L=4.0 /")
    call take_list(asperities, .true.)
    call read_asperities(asperities, .true.)
    call contact%create(asperities, 3e3_dp, infinity, 0.4375_dp, 1.25_dp, options, stat, msg)
    call told('rsc_contact_create')
    call indent(contact, 0.015625_dp)
    call read_contact(contact, .false.)
    call read_case(bent, "&asperities law='fourth_order' / &surface L=2.5 /")
    call contact%create(asperities, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, bent, stat, msg)
    call told('rsc_contact_create')
    call indent(contact, -0.28125_dp)
    call read_contact(contact, .false.)
    call read_case(soft, '&solids hardness=512.0 / &surface L=4.0 /')
    call contact%create_from_case(asperities, soft, stat, msg)
    call told('rsc_contact_create_from_case')
    do k = 1, 3
      call indent(contact, separations(k))
      call put('rsc_contact_value.value', contact%value('plastic_contacts', stat, msg))
      call told('rsc_contact_value')
      call put('rsc_contact_value.value', contact%value('plastic_work', stat, msg))
      call told('rsc_contact_value')
    end do
    call contact%save('soft.kept', stat, msg)
    call told('rsc_contact_save')
    call friction%create(contact, 0.3125_dp, 0.8125_dp, stat, msg)
    call told('rsc_friction_create')
  end subroutine

  subroutine flats()
    type(rsc_case) :: options
    type(rsc_surface) :: surface
    type(rsc_asperities) :: on
    type(rsc_contact) :: contact
    logical :: elements
    integer :: k
    do k = 1, 2
      elements = k == 2
      scene = merge('elements', 'flats   ', elements)
      call read_case(options, '&surface L=2, n=64, L_lambda_l=2, L_lambda_s=8, sigma=0.015625 / &solver tolerance=1e-9 / ' // &
                     "&solids E=3, 5  nu=0.125, 0.25  R=Infinity, Infinity / &indentation boundary='periodic' /")
      if (elements) call options%set('solver%model', "'elements'", stat, msg)
      call told('rsc_case_set')
      call surface%synthesize(options, 2, stat, msg)
      call told('rsc_surface_synthesize')
      call on%find(surface, options, stat, msg)
      call told('rsc_asperities_find')
      call read_asperities(on, .not. elements)
      call contact%create_from_case(on, options, stat, msg)
      call told('rsc_contact_create_from_case')
      call tip(contact)
      call press(contact, 0.0625_dp)
      call read_contact(contact, .true.)
      if (elements) then
        call contact%per_asperity(stat=stat, errmsg=msg)
        call told('rsc_contact_per_asperity')
        call contact%save('elements.kept', stat, msg)
        call told('rsc_contact_save')
      end if
    end do
  end subroutine

  subroutine unfinished()
    type(rsc_case) :: options
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact
    type(rsc_friction) :: friction
    scene = 'unfinished'
    call read_case(options, '&solver max_iterations=1, tolerance=1e-14 /')
    call take_list(asperities, .false.)
    call contact%create(asperities, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, options, stat, msg)
    call told('rsc_contact_create')
    call indent(contact, 0.0_dp)
    call read_contact(contact, .false.)
    call press(contact, 8.0_dp)
    call read_contact(contact, .false.)
    call options%set('solids%friction', 0.25_dp, stat, msg)
    call told('rsc_case_set')
    call friction%create_from_case(contact, options, stat, msg)
    call told('rsc_friction_create_from_case')
    call update(friction, 0.0_dp, 0.5_dp, 0.25_dp)
  end subroutine

  subroutine many()
    type(rsc_case) :: few
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contacts(3)
    real(dp) :: Z(3), N(3)
    real(dp), parameter :: bad(3) = [5.0_dp, -1.0_dp, 7.0_dp]
    integer(c_int32_t) :: each(3)
    integer :: k
    scene = 'many'
    call read_case(few, '&solver max_iterations=1, tolerance=1e-14 /')
    call take_list(asperities, .false.)
    do k = 0, 2
      if (k == 1) call contacts(k + 1)%create(asperities, 3e3_dp, 4.0_dp, 0.375_dp + 0.125_dp * k, 1.25_dp - 0.0625_dp * k, few, &
                                              stat, msg)
      if (k /= 1) call contacts(k + 1)%create(asperities, 3e3_dp, 4.0_dp, 0.375_dp + 0.125_dp * k, 1.25_dp - 0.0625_dp * k, &
                                              stat=stat, errmsg=msg)
      call told('rsc_contact_create')
    end do
    call rsc_indent_all(contacts, [0.0_dp, 0.015625_dp, -0.015625_dp], N, 2, each, stat, msg)
    call told('rsc_contacts_indent')
    call put('rsc_contacts_indent.force', N)
    call put('rsc_contacts_indent.status', int(each))
    call rsc_press_all(contacts, [4.0_dp, 6.0_dp, 9.0_dp], Z, 2, each, stat, msg)
    call told('rsc_contacts_press')
    call put('rsc_contacts_press.separation', Z)
    call put('rsc_contacts_press.status', int(each))
    call rsc_press_all(contacts, bad, Z, stat=stat, errmsg=msg)
    call told('rsc_contacts_press')
    scene = 'many_refused'
    Z = 7
    call rsc_press_all(contacts, bad, Z, 1, each, stat, msg)
    call told('rsc_contacts_press')
    call put('rsc_contacts_press.separation', Z)
    call put('rsc_contacts_press.status', int(each))
  end subroutine

  subroutine state(friction)
    type(rsc_friction), intent(in) :: friction
    real(dp) :: at, x, y, N, fx, fy, W, V, lost, stick, one, more
    call friction%state(at, x, y, N, fx, fy, W, V, lost, stick, stat, msg)
    call told('rsc_friction_state')
    call put('rsc_friction_state.separation', at)
    call put('rsc_friction_state.x', x)
    call put('rsc_friction_state.y', y)
    call put('rsc_friction_state.force', N)
    call put('rsc_friction_state.force_x', fx)
    call put('rsc_friction_state.force_y', fy)
    call put('rsc_friction_state.energy', W)
    call put('rsc_friction_state.tangential_energy', V)
    call put('rsc_friction_state.lost', lost)
    call put('rsc_friction_state.stick_separation', stick)
    call friction%state(stick_separation=one, force_y=more, stat=stat, errmsg=msg)
    call alone(same(one, stick) .and. same(more, fy), 'rsc_friction_state')
  end subroutine

  subroutine update(friction, separation, x, y)
    type(rsc_friction), intent(inout) :: friction
    real(dp), intent(in) :: separation, x, y
    real(dp) :: N, fx, fy, lost
    call friction%update(separation, x, y, N, fx, fy, lost, stat, msg)
    call told('rsc_friction_update')
    call put('rsc_friction_update.force', N)
    call put('rsc_friction_update.force_x', fx)
    call put('rsc_friction_update.force_y', fy)
    call put('rsc_friction_update.lost', lost)
  end subroutine

  subroutine read_friction(friction)
    type(rsc_friction), intent(inout) :: friction
    real(dp) :: k(2, 2), slide, most, Q(3), stick(3)
    integer, allocatable :: which(:), whom(:)
    real(dp), allocatable :: radius(:), inner(:), fx(:), fy(:)
    call state(friction)
    k = friction%stiffness(stat, msg)
    call told('rsc_friction_stiffness')
    call put('rsc_friction_stiffness.xx', k(1, 1))
    call put('rsc_friction_stiffness.xy', k(1, 2))
    call put('rsc_friction_stiffness.yx', k(2, 1))
    call put('rsc_friction_stiffness.yy', k(2, 2))
    call friction%full_slip(slide, most, stat, msg)
    call told('rsc_friction_full_slip')
    call put('rsc_friction_full_slip.slide', slide)
    call put('rsc_friction_full_slip.force', most)
    call friction%first_loading([0.0_dp, 0.00390625_dp, 0.0078125_dp], Q, stick, stat, msg)
    call told('rsc_friction_first_loading')
    call put('rsc_friction_first_loading.force', Q)
    call put('rsc_friction_first_loading.stick_separation', stick)
    call put('rsc_friction_slide.slide', friction%slide(1.25_dp, stat, msg))
    call told('rsc_friction_slide')
    call friction%spots(which, radius, inner, fx, fy, stat, msg)
    call told('rsc_friction_spots')
    call put('rsc_friction_spots.asperity', which - 1)
    call put('rsc_friction_spots.radius', radius)
    call put('rsc_friction_spots.stick_radius', inner)
    call put('rsc_friction_spots.force_x', fx)
    call put('rsc_friction_spots.force_y', fy)
    call friction%spots(asperity=whom, stat=stat, errmsg=msg)
    call alone(all(whom == which), 'rsc_friction_spots')
  end subroutine

  subroutine frictions()
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact
    type(rsc_friction) :: friction, other
    type(rsc_case) :: options
    real(dp), parameter :: E(2) = [1e3_dp, 3e3_dp], nu(2) = [0.125_dp, 0.375_dp]
    real(dp) :: value, one(1)
    scene = 'friction'
    call put('rsc_tangential_ratio.ratio', rsc_stiffness_ratio(E, nu, stat, msg))
    call told('rsc_tangential_ratio')
    value = rsc_stiffness_ratio(E, [0.125_dp, 0.625_dp], stat, msg)
    call told('rsc_tangential_ratio')
    value = rsc_stiffness_ratio([infinity, infinity], nu, stat, msg)
    call told('rsc_tangential_ratio')
    call take_list(asperities, .false.)
    call contact%create(asperities, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, stat=stat, errmsg=msg)
    call told('rsc_contact_create')
    call friction%create(contact, -1.0_dp, 0.8125_dp, stat, msg)
    call told('rsc_friction_create')
    call friction%create(contact, 0.3125_dp, 0.0_dp, stat, msg)
    call told('rsc_friction_create')
    call friction%create(contact, 0.3125_dp, 0.8125_dp, stat, msg)
    call told('rsc_friction_create')
    call friction%state(stat=stat, errmsg=msg)
    call told('rsc_friction_state')
    call update(friction, 0.015625_dp, 0.5_dp, 0.25_dp)
    call update(friction, 0.0_dp, 0.501953125_dp, 0.25_dp)
    call update(friction, 0.00390625_dp, 0.5029296875_dp, 0.251953125_dp)
    call read_friction(friction)
    call friction%commit(stat, msg)
    call told('rsc_friction_commit')
    call update(friction, 0.0_dp, 0.5_dp, 0.25390625_dp)
    call read_friction(friction)
    other = friction
    call friction%rollback(stat, msg)
    call told('rsc_friction_rollback')
    call state(friction)
    call state(other)
    call other%save('friction.kept', stat, msg)
    call told('rsc_friction_save')
    call update(other, 0.001953125_dp, 0.515625_dp, 0.25_dp)
    call read_friction(other)
    call other%restore(asperities, 'friction.kept', stat, msg)
    call told('rsc_friction_restore')
    call state(other)
    call other%rollback(stat, msg)
    call told('rsc_friction_rollback')
    call state(other)
    call friction%update(nan, 0.5_dp, 0.25_dp, stat=stat, errmsg=msg)
    call told('rsc_friction_update')
    call friction%update(0.0_dp, nan, 0.25_dp, stat=stat, errmsg=msg)
    call told('rsc_friction_update')
    call friction%update(0.0_dp, 0.5_dp, nan, stat=stat, errmsg=msg)
    call told('rsc_friction_update')
    value = friction%slide(1e6_dp, stat, msg)
    call told('rsc_friction_slide')
    call friction%first_loading([-1.0_dp], one, stat=stat, errmsg=msg)
    call told('rsc_friction_first_loading')
    call state(friction)
    call friction%save('no/folder/friction.kept', stat, msg)
    call told('rsc_friction_save')
    call friction%restore(asperities, 'nothing.kept', stat, msg)
    call told('rsc_friction_restore')
    scene = 'friction_case'
    call read_case(options, '&solids E=1e3, 3e3  nu=0.125, 0.375  friction=0.1875 /')
    call friction%create_from_case(contact, options, stat, msg)
    call told('rsc_friction_create_from_case')
    call update(friction, 0.0_dp, 0.5_dp, 0.25_dp)
    call update(friction, 0.0_dp, 0.501953125_dp, 0.2490234375_dp)
    call friction%commit(stat, msg)
    call told('rsc_friction_commit')
    call update(friction, 0.00390625_dp, 0.53125_dp, 0.2490234375_dp)
    call friction%rollback(stat, msg)
    call told('rsc_friction_rollback')
    call update(friction, 0.00390625_dp, 0.5_dp, 0.2490234375_dp)
  end subroutine

  ! What this module refuses itself: each array of another size than the others, objects that hold nothing. The objects are as before.
  subroutine sizes()
    type(rsc_surface) :: surface
    type(rsc_asperities) :: asperities, none
    type(rsc_contact) :: contact, contacts(2)
    type(rsc_friction) :: friction
    real(dp), dimension(2) :: x = [0.0_dp, 1.0_dp], y = [0.0_dp, 2.0_dp], r = [1.0_dp, 2.0_dp], a, b
    real(dp) :: one(1) = 1, three(3) = 1, z(4, 3), value
    integer(c_int32_t) :: each(2), each_1(1)
    integer :: k
    scene = 'own'
    z = 0
    a = 7
    b = 7
    call surface%take(z, 1.0_dp)
    call surface%heights(z(:, :2), stat, msg)
    call told('surface%heights')
    call surface%heights(z(:3, :), stat, msg)
    call told('surface%heights')
    call asperities%take(x, three, y, r, stat=stat, errmsg=msg)
    call told('asperities%take')
    call asperities%take(x, y, one, r, stat=stat, errmsg=msg)
    call told('asperities%take')
    call asperities%take(x, y, y, three, stat=stat, errmsg=msg)
    call told('asperities%take')
    call asperities%take(x, y, y, r, three, r, r, stat=stat, errmsg=msg)
    call told('asperities%take')
    call asperities%take(x, y, y, r, r, three, r, stat=stat, errmsg=msg)
    call told('asperities%take')
    call asperities%take(x, y, y, r, r, r, three, stat=stat, errmsg=msg)
    call told('asperities%take')
    call asperities%take(x, y, y, r, r, r, r, three, stat, msg)
    call told('asperities%take')
    k = asperities%count(stat, msg)  ! it holds nothing now
    call told('asperities%count')
    call put('asperities%count', k)
    call asperities%take(x, y, [0.0_dp, 0.0_dp], r, stat=stat, errmsg=msg)
    call contact%create(none, 1e3_dp, 4.0_dp, 0.0_dp, 0.0_dp, stat=stat, errmsg=msg)
    call told('contact%create')
    do k = 1, 2
      call contacts(k)%create(asperities, 1e3_dp, 4.0_dp, x(k), y(k), stat=stat, errmsg=msg)
      call told('contact%create')
    end do
    call contacts(1)%indent(-0.5_dp, stat=stat, errmsg=msg)
    call contacts(1)%per_asperity(one, stat=stat, errmsg=msg)
    call told('contact%per_asperity')
    call contacts(1)%per_asperity(radius=three, stat=stat, errmsg=msg)
    call told('contact%per_asperity')
    call contacts(1)%per_asperity(penetration=one, stat=stat, errmsg=msg)
    call told('contact%per_asperity')
    call contacts(1)%deflection(x, three, a, stat, msg)
    call told('contact%deflection')
    call contacts(1)%deflection(x, y, three, stat, msg)
    call told('contact%deflection')
    call rsc_press_all(contacts, three, a, stat=stat, errmsg=msg)
    call told('rsc_press_all')
    call rsc_press_all(contacts, r, one, stat=stat, errmsg=msg)
    call told('rsc_press_all')
    call rsc_press_all(contacts, r, a, each=each_1, stat=stat, errmsg=msg)
    call told('rsc_press_all')
    call rsc_indent_all(contacts, one, a, stat=stat, errmsg=msg)
    call told('rsc_indent_all')
    call rsc_indent_all(contacts, r, three, stat=stat, errmsg=msg)
    call told('rsc_indent_all')
    call rsc_indent_all(contacts, r, a, each=each_1, stat=stat, errmsg=msg)
    call told('rsc_indent_all')
    call rsc_press_all(contacts, r, a, -1, each, stat, msg)
    call told('rsc_press_all')
    call friction%create(contacts(1), 0.25_dp, 0.75_dp, stat, msg)
    call friction%update(-0.5_dp, 0.0_dp, 0.0_dp, stat=stat, errmsg=msg)
    call told('friction%update')
    call friction%first_loading([0.0_dp], a, stat=stat, errmsg=msg)
    call told('friction%first_loading')
    call friction%first_loading([0.0_dp, 1e-3_dp], a, three, stat, msg)
    call told('friction%first_loading')
    if (any(abs(a - 7) > 0)) call put('own', 'an array was written')
    value = contacts(1)%force(stat, msg)
    call told('contact%force')
    if (.not. value > 0) call put('contact%force', 'lost')
    value = contact%area(stat, msg)
    call told('contact%area')
    call put('contact%area', value)
    call contacts(1)%create(asperities, -1.0_dp, 4.0_dp, 0.0_dp, 0.0_dp, stat=stat)
    value = contacts(1)%force(stat, msg)  ! what was created before is gone
    call told('contact%force')
  end subroutine
end program
