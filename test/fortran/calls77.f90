! What calls.cpp does as far as rsc77.c goes: the same calls in the same order, every value they give back printed in the same words; and
! for every routine, what it says to a handle of another kind or of nothing.
program calls77
  use calls_common, only: put, scene, points, oblong_map
  implicit none
  integer, parameter :: dp = kind(1d0), long = selected_int_kind(18)
  external :: rscver, rscmsg, rscdel, rsccpy, rsccas, rscred, rscset, rscget, rscrun, rscsyn, rscsur, rschgt, rscfnd, rscmak
  external :: rscasp, rscnum, rscxyz, rsccon, rsccnc, rsctip, rsctch, rscind, rscprs, rscres, rsclev, rscstf, rscnrg, rscspt
  external :: rscdfl, rscfri, rscupd, rsccmt, rscrbk
  character(30) :: buffer
  integer :: ierr, said = 0
  real(dp) :: nan, infinity, zero = 0
  nan = zero / zero
  infinity = 1 / zero
  scene = 'texts'
  call rscver(buffer)
  call put('rsc_version.buffer', buffer)
  call cases()
  call surfaces()
  call synthetic()
  call list()
  call flats()
  call unfinished()
  call friction_case()
  call handles()

contains

  subroutine told(function)
    character(*), intent(in) :: function
    character(12) :: code
    character(2000) :: msg
    if (ierr == 0) return
    call rscmsg(msg)
    write (code, '(i0)') ierr
    call put(function // '.code', trim(code) // ' ' // msg)
  end subroutine

  subroutine expect(ok, what)
    logical, intent(in) :: ok
    character(*), intent(in) :: what
    if (.not. ok) call put('wrong', what)
  end subroutine

  ! The handle that is argument number i is refused, in words of the table of handles.
  subroutine no_handle(i, what)
    integer, intent(in) :: i
    character(*), intent(in) :: what
    character(100) :: msg
    call rscmsg(msg)
    if (said < 3) call put('no_handle', msg)  ! of a case, of anything else
    said = said + 1
    call expect(ierr == -i .and. index(msg, 'not a handle') == 1 .and. index(msg, 'deleted') > 0, what // ': ' // msg)
  end subroutine

  subroutine read_case(icase, text)
    integer, intent(out) :: icase
    character(*), intent(in) :: text
    icase = 0
    call rsccas(icase, ierr)
    call told('rsc_case_create')
    call rscred(icase, text, ierr)
    call told('rsc_case_read')
  end subroutine

  subroutine delete(handle)
    integer, intent(inout) :: handle
    call rscdel(handle, ierr)
    call expect(ierr == 0 .and. handle == 0, 'rscdel')
  end subroutine

  subroutine take_list(iasp)
    integer, intent(out) :: iasp
    real(dp), dimension(35) :: x, y, z, radius
    call points(x, y, z, radius)
    iasp = 0
    call rscasp(iasp, 35, x, y, z, radius, ierr)
    call told('rsc_asperities_take')
  end subroutine

  subroutine read_asperities(iasp)
    integer, intent(in) :: iasp
    integer :: n
    real(dp), allocatable :: x(:), y(:), z(:), radius(:)
    n = -7
    call rscnum(iasp, n, ierr)
    call told('rsc_asperities_count')
    call put('rsc_asperities_count.n', n)
    allocate (x(n), y(n), z(n), radius(n))
    call rscxyz(iasp, n, x, y, z, radius, ierr)
    call told('rsc_asperities_get')
    call put('rsc_asperities_get.x', x)
    call put('rsc_asperities_get.y', y)
    call put('rsc_asperities_get.z', z)
    call put('rsc_asperities_get.radius', radius)
    call rscxyz(iasp, n + 1, x, y, z, radius, ierr)
    call expect(ierr == -2, 'rscxyz: another number')
  end subroutine

  subroutine read_heights(isurf, n)
    integer, intent(in) :: isurf, n
    real(dp) :: z(n)
    z = -7
    call rschgt(isurf, n - 1, z, ierr)
    call expect(ierr == -2 .and. all(abs(z + 7) <= 0), 'rschgt: another number')
    call rschgt(isurf, n, z, ierr)
    call told('rsc_surface_heights')
    call put('rsc_surface_heights.heights', z)
  end subroutine

  subroutine touch(icon)
    integer, intent(in) :: icon
    real(dp) :: separation
    call rsctch(icon, separation, ierr)
    call told('rsc_contact_first_touch')
    call put('rsc_contact_first_touch.separation', separation)
  end subroutine

  subroutine read_contact(icon)
    integer, intent(in) :: icon
    integer :: n, status, candidates, iterations, overlapping
    integer, allocatable :: which(:)
    real(dp) :: Z, F, A, residual, stiffness, energy, w(3)
    real(dp), allocatable :: force(:), radius(:), penetration(:)
    call rscres(icon, Z, F, A, n, ierr)
    call told('rsc_contact_result')
    call put('rsc_contact_result.separation', Z)
    call put('rsc_contact_result.force', F)
    call put('rsc_contact_result.area', A)
    call put('rsc_contact_result.contacts', n)
    call rsclev(icon, status, candidates, iterations, overlapping, residual, ierr)
    call told('rsc_contact_level')
    call put('rsc_contact_level.level_status', status)
    call put('rsc_contact_level.candidates', candidates)
    call put('rsc_contact_level.iterations', iterations)
    call put('rsc_contact_level.overlapping_pairs', overlapping)
    call put('rsc_contact_level.residual', residual)
    call rscstf(icon, stiffness, ierr)
    call told('rsc_contact_stiffness')
    call put('rsc_contact_stiffness.stiffness', stiffness)
    call rscnrg(icon, energy, ierr)
    call told('rsc_contact_energy')
    call put('rsc_contact_energy.energy', energy)
    allocate (which(n + 1), force(n + 1), radius(n + 1), penetration(n + 1))
    which = -7
    force = -7
    call rscspt(icon, n - 1, which, force, radius, penetration, ierr)
    call expect(ierr == -2 .and. all(which == -7) .and. all(abs(force + 7) <= 0), 'rscspt: too short')
    call rscspt(icon, n + 1, which, force, radius, penetration, ierr)
    call told('rsc_contact_spots')
    call put('rsc_contact_spots.asperity', which(:n) - 1)
    call put('rsc_contact_spots.force', force(:n))
    call put('rsc_contact_spots.radius', radius(:n))
    call put('rsc_contact_spots.penetration', penetration(:n))
    call expect(which(n + 1) == -7 .and. abs(force(n + 1) + 7) <= 0, 'rscspt: beyond the number of contacts')
    call rscdfl(icon, 3, [0.25_dp, 0.375_dp, 0.75_dp], [1.25_dp, 0.875_dp, 1.0_dp], w, ierr)
    call told('rsc_contact_deflection')
    call put('rsc_contact_deflection.deflection', w)
  end subroutine

  subroutine indent(icon, separation)
    integer, intent(in) :: icon
    real(dp), intent(in) :: separation
    real(dp) :: force
    call rscind(icon, separation, force, ierr)
    call told('rsc_contact_indent')
    call put('rsc_contact_indent.force', force)
  end subroutine

  subroutine press(icon, force)
    integer, intent(in) :: icon
    real(dp), intent(in) :: force
    real(dp) :: separation
    call rscprs(icon, force, separation, ierr)
    call told('rsc_contact_press')
    call put('rsc_contact_press.separation', separation)
  end subroutine

  subroutine get(icase, name)
    integer, intent(in) :: icase
    character(*), intent(in) :: name
    character(60) :: value
    call rscget(icase, name, value, ierr)
    call told('rsc_case_get')
    call put('rsc_case_get.buffer', value)
  end subroutine

  subroutine cases()
    integer :: icase, other, failed, k, unit, length
    character(3) :: cut
    character(5000) :: long_text
    character(:), allocatable :: text
    character(24), parameter :: keys(2, 12) = reshape([character(24) :: &
      'surface%sigma', '0.30000000000000004', 'surface%hurst', '0.1', &
      'surface%n', '4096', 'run%seed', '9000000000', 'surface%plateau', &
      '.true.', 'solids%E', '0.1, 0.7', 'solids%nu', '0.1, 0.3', 'indentation%levels', '3 2 1', 'solver%method', "'direct'", &
      'run%title', "'it''s'", 'indentation%centre(2)', '0.625', 'output%heights', '.false.'], [2, 12])
    scene = 'cases'
    icase = 0
    other = 0
    call rsccas(icase, ierr)
    call told('rsc_case_create')
    do k = 1, 12
      call rscset(icase, keys(1, k), keys(2, k), ierr)
      call told('rsc_case_set')
      call get(icase, keys(1, k))
    end do
    call rscset(icase, 'surface%file', "'" // repeat('f', 4096) // "'", ierr)
    call told('rsc_case_set')
    call rscget(icase, 'surface%file', long_text, ierr)
    call put('rsc_case_get.buffer', long_text)
    call rsccpy(other, icase, ierr)
    call told('rsc_case_copy')
    call expect(other /= icase .and. other > 0, 'rsccpy: another handle')
    call rscset(icase, 'surface%sigma', '0.03125', ierr)
    call told('rsc_case_set')
    call get(other, 'surface%sigma')
    call rscset(icase, 'surface%simga', '1', ierr)
    call told('rsc_case_set')
    call rscset(icase, 'surface%sigma', '-1', ierr)
    call told('rsc_case_set')
    cut = 'old'
    call rscget(icase, 'surface%simga', cut, ierr)
    call told('rsc_case_get')
    call expect(cut == 'old', 'rscget: the value after a failure')
    call rscset(icase, 'surface%simgb    ', '1', ierr)
    call rscmsg(buffer)
    call expect(ierr == -2 .and. buffer == "unknown key 'simgb'", 'rscset: blanks after the name: ' // buffer)
    call rscred(icase, '&surface n=3 /', ierr)
    call told('rsc_case_read')
    call get(icase, 'surface%sigma')
    call rscget(icase, 'surface%sigma', cut, ierr)
    call expect(ierr == 0 .and. cut == '0.0', 'rscget: a short text is cut')
    call rscred(icase, '&surface n=128, L_lambda_l=4, L_lambda_s=32, sigma=0.25 / &solids nu=0.1, 0.2 /', ierr)
    call told('rsc_case_read')
    open (newunit=unit, file='calls.nml', access='stream', status='old')
    inquire (unit, size=length)
    allocate (character(length) :: text)
    read (unit) text
    close (unit)
    call rscred(other, text, ierr)
    failed = -7
    call rscrun(other, failed, ierr)
    call told('rsc_case_run')
    call put('rsc_case_run.failed_levels', failed)
    call rscset(other, 'surface%n', '16', ierr)
    call told('rsc_case_set')
    failed = -7
    call rscrun(other, failed, ierr)
    call told('rsc_case_run')
    call expect(failed == -7, 'rscrun: failed levels after a failure')
    call delete(icase)
    call delete(other)
  end subroutine

  subroutine surfaces()
    integer :: icase, isurf, iasp, k, copy
    real(dp) :: z(9, 7)
    scene = 'surfaces'
    z = oblong_map()
    call read_case(icase, "&asperities curvature='algebraic' /")
    do k = 1, 0, -1
      call rscsur(isurf, 9, 7, 0.125_dp, 0.1875_dp, -0.5_dp, 0.75_dp, k, z, ierr)
      call told('rsc_surface_take')
      call rsccpy(copy, isurf, ierr)
      call told('rsc_surface_copy')
      call delete(isurf)
      call read_heights(copy, 63)
      call rscfnd(iasp, copy, 0, ierr)
      call told('rsc_asperities_find')
      call read_asperities(iasp)
      call delete(iasp)
      call rscfnd(iasp, copy, icase, ierr)
      call told('rsc_asperities_find')
      call read_asperities(iasp)
      call delete(iasp)
      call delete(copy)
    end do
    isurf = -7
    call rscsur(isurf, 9, 7, 0.0_dp, 0.1875_dp, -0.5_dp, 0.75_dp, 0, z, ierr)
    call told('rsc_surface_take')
    call rscsur(isurf, 9, 7, 0.125_dp, -1.0_dp, -0.5_dp, 0.75_dp, 0, z, ierr)
    call told('rsc_surface_take')
    call rscsur(isurf, 9, 7, 0.125_dp, 0.1875_dp, nan, 0.75_dp, 0, z, ierr)
    call told('rsc_surface_take')
    call rscsur(isurf, 9, 7, 0.125_dp, 0.1875_dp, -0.5_dp, infinity, 0, z, ierr)
    call told('rsc_surface_take')
    z(6, 1) = nan
    call rscsur(isurf, 9, 7, 0.125_dp, 0.1875_dp, -0.5_dp, 0.75_dp, 0, z, ierr)
    call told('rsc_surface_take')
    call rscsur(isurf, 2, 7, 0.125_dp, 0.1875_dp, -0.5_dp, 0.75_dp, 0, z, ierr)
    call expect(ierr == -2, 'rscsur: nx')
    call rscsur(isurf, 9, 2, 0.125_dp, 0.1875_dp, -0.5_dp, 0.75_dp, 0, z, ierr)
    call expect(ierr == -3, 'rscsur: ny')
    call rscsur(isurf, 9, 7, 0.125_dp, 0.1875_dp, -0.5_dp, 0.75_dp, 2, z, ierr)
    call expect(ierr == -8, 'rscsur: periodic')
    call expect(isurf == -7, 'rscsur: the handle after a failure')
    call delete(icase)
  end subroutine

  subroutine synthetic()
    integer :: icase, isurf, iasp, icon, other, k
    scene = 'synthetic'
    call read_case(icase, '&surface n=64, L=1.5, L_lambda_l=2, L_lambda_s=8, sigma=0.03125 / &run seed=5 / ' // &
                   '&solids E=1e3, 3e3  nu=0.125, 0.375  R=3.0, 5.0  resistivity=1e-5, 3e-5 / &indentation centre=0.625, 0.875 /')
    do k = 3, 1, -2
      call rscsyn(isurf, icase, k, ierr)
      call told('rsc_surface_synthesize')
      call read_heights(isurf, 4096)
      call rscmak(iasp, icase, k, ierr)
      call told('rsc_asperities_make')
      call read_asperities(iasp)
      call delete(isurf)
      if (k == 3) call delete(iasp)
    end do
    call rsccpy(other, iasp, ierr)
    call told('rsc_asperities_copy')
    call delete(iasp)
    call read_asperities(other)
    call rsccnc(icon, other, icase, ierr)
    call told('rsc_contact_create_from_case')
    call touch(icon)
    call indent(icon, 0.03125_dp)
    call read_contact(icon)
    call delete(icon)
    call rscset(icase, 'surface%n', '16', ierr)
    call told('rsc_case_set')
    call rscsyn(isurf, icase, 1, ierr)
    call told('rsc_surface_synthesize')
    call rscmak(iasp, icase, 1, ierr)
    call told('rsc_asperities_make')
    call rscset(icase, 'solver%model', "'elements'", ierr)
    call told('rsc_case_set')
    call rsccnc(icon, other, icase, ierr)
    call told('rsc_contact_create_from_case')
    call expect(iasp == 0 .and. icon == 0 .and. isurf == 0, 'handles after a failure')
    call delete(other)
    call delete(icase)
  end subroutine

  subroutine list()
    integer :: icase, iasp, icon, other, n
    real(dp) :: one(1), two(1), none(1), w(2), value, values(4)
    scene = 'list'
    call read_case(icase, '&solver tolerance=1e-9 / &surface L=4.0 /')
    call take_list(iasp)
    call read_asperities(iasp)
    call rsccon(icon, iasp, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, icase, ierr)
    call told('rsc_contact_create')
    call touch(icon)
    values = -7
    n = -7
    call rscres(icon, values(1), values(2), values(3), n, ierr)
    call told('rsc_contact_result')
    call rscprs(icon, -1.0_dp, values(4), ierr)
    call told('rsc_contact_press')
    call expect(n == -7 .and. all(abs(values + 7) <= 0), 'outputs after a failure')
    call indent(icon, 0.0_dp)
    call read_contact(icon)
    call press(icon, 8.0_dp)
    call read_contact(icon)
    call rsctip(icon, 0.5_dp, 0.9375_dp, ierr)
    call told('rsc_contact_move_tip')
    call touch(icon)
    call read_contact(icon)
    call rsccpy(other, icon, ierr)
    call told('rsc_contact_copy')
    call touch(other)
    call rscnrg(other, value, ierr)
    call told('rsc_contact_energy')
    call indent(icon, -0.015625_dp)
    call read_contact(icon)
    call indent(other, -0.015625_dp)
    call read_contact(other)
    call rscind(icon, nan, value, ierr)
    call told('rsc_contact_indent')
    call rscprs(icon, -1.0_dp, value, ierr)
    call told('rsc_contact_press')
    call rsctip(icon, 1e3_dp, 1.0_dp, ierr)
    call told('rsc_contact_move_tip')
    call rsctip(icon, nan, 1.0_dp, ierr)
    call told('rsc_contact_move_tip')
    call rsctip(icon, 1.0_dp, infinity, ierr)
    call told('rsc_contact_move_tip')
    call rscdfl(icon, 2, [0.25_dp, nan], [0.5_dp, 0.75_dp], w, ierr)
    call told('rsc_contact_deflection')
    call rscdfl(icon, 2, [0.5_dp, 0.75_dp], [0.25_dp, nan], w, ierr)
    call told('rsc_contact_deflection')
    call touch(icon)
    call read_contact(icon)
    call delete(icon)
    call rsccon(icon, iasp, -1.0_dp, 4.0_dp, 0.5_dp, 1.0_dp, icase, ierr)
    call told('rsc_contact_create')
    call rsccon(icon, iasp, 3e3_dp, 0.0_dp, 0.5_dp, 1.0_dp, icase, ierr)
    call told('rsc_contact_create')
    call rsccon(icon, iasp, 3e3_dp, 4.0_dp, nan, 1.0_dp, icase, ierr)
    call told('rsc_contact_create')
    call rsccon(icon, iasp, 3e3_dp, 4.0_dp, 0.5_dp, nan, icase, ierr)
    call told('rsc_contact_create')
    call rscset(icase, 'solver%model', "'elements'", ierr)
    call told('rsc_case_set')
    call rsccon(icon, iasp, 3e3_dp, 4.0_dp, 0.5_dp, 1.0_dp, icase, ierr)
    call told('rsc_contact_create')
    one = 1
    two = 0.5_dp
    none = 0
    call delete(iasp)
    call rscasp(iasp, 1, one, two, none, none, ierr)
    call told('rsc_asperities_take')
    call rscasp(iasp, 2, [1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], ierr)
    call told('rsc_asperities_take')
    call expect(iasp == 0 .and. icon == 0, 'handles after a failure')
    call delete(other)
    call delete(icase)
  end subroutine

  subroutine flats()
    integer :: icase, isurf, iasp, icon, k
    do k = 1, 2
      scene = merge('elements', 'flats   ', k == 2)
      call read_case(icase, '&surface L=2, n=64, L_lambda_l=2, L_lambda_s=8, sigma=0.015625 / &solver tolerance=1e-9 / ' // &
                     "&solids E=3, 5  nu=0.125, 0.25  R=Infinity, Infinity / &indentation boundary='periodic' /")
      if (k == 2) call rscset(icase, 'solver%model', "'elements'", ierr)
      call told('rsc_case_set')
      call rscsyn(isurf, icase, 2, ierr)
      call told('rsc_surface_synthesize')
      call rscfnd(iasp, isurf, icase, ierr)
      call told('rsc_asperities_find')
      call read_asperities(iasp)
      call rsccnc(icon, iasp, icase, ierr)
      call told('rsc_contact_create_from_case')
      call touch(icon)
      call press(icon, 0.0625_dp)
      call read_contact(icon)
      call delete(icon)
      call delete(iasp)
      call delete(isurf)
      call delete(icase)
    end do
  end subroutine

  subroutine update(ifri, separation, x, y)
    integer, intent(in) :: ifri
    real(dp), intent(in) :: separation, x, y
    real(dp) :: force, fx, fy, lost
    call rscupd(ifri, separation, x, y, force, fx, fy, lost, ierr)
    call told('rsc_friction_update')
    call put('rsc_friction_update.force', force)
    call put('rsc_friction_update.force_x', fx)
    call put('rsc_friction_update.force_y', fy)
    call put('rsc_friction_update.lost', lost)
  end subroutine

  subroutine unfinished()
    integer :: icase, iasp, icon, ifri
    scene = 'unfinished'
    call read_case(icase, '&solver max_iterations=1, tolerance=1e-14 /')
    call take_list(iasp)
    call rsccon(icon, iasp, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, icase, ierr)
    call told('rsc_contact_create')
    call indent(icon, 0.0_dp)
    call read_contact(icon)
    call press(icon, 8.0_dp)
    call read_contact(icon)
    call rscset(icase, 'solids%friction', '0.25', ierr)
    call told('rsc_case_set')
    call rscfri(ifri, icon, icase, ierr)
    call told('rsc_friction_create_from_case')
    call update(ifri, 0.0_dp, 0.5_dp, 0.25_dp)
    call delete(ifri)
    call delete(icon)
    call delete(iasp)
    call delete(icase)
  end subroutine

  subroutine friction_case()
    integer :: icase, iasp, icon, ifri, copy
    real(dp) :: force, fx(2), fy(2), lost(2)
    scene = 'friction_case'
    call take_list(iasp)
    call rsccon(icon, iasp, 3e3_dp, 4.0_dp, 0.4375_dp, 1.25_dp, 0, ierr)
    call told('rsc_contact_create')
    call read_case(icase, '&solids E=1e3, 3e3  nu=0.125, 0.375  friction=0.1875 /')
    call rscfri(ifri, icon, icase, ierr)
    call told('rsc_friction_create_from_case')
    call update(ifri, 0.0_dp, 0.5_dp, 0.25_dp)
    call update(ifri, 0.0_dp, 0.501953125_dp, 0.2490234375_dp)
    call rsccmt(ifri, ierr)
    call told('rsc_friction_commit')
    call update(ifri, 0.00390625_dp, 0.53125_dp, 0.2490234375_dp)
    call rscrbk(ifri, ierr)
    call told('rsc_friction_rollback')
    call update(ifri, 0.00390625_dp, 0.5_dp, 0.2490234375_dp)
    call rsccpy(copy, ifri, ierr)
    call told('rsc_friction_copy')
    call rscupd(ifri, 0.0_dp, 0.5_dp, 0.28125_dp, force, fx(1), fy(1), lost(1), ierr)
    call rscupd(copy, 0.0_dp, 0.5_dp, 0.28125_dp, force, fx(2), fy(2), lost(2), ierr)
    call expect(ierr == 0 .and. all(abs(fx - fx(1)) <= 1e-6_dp * fy(1)) .and. abs(fy(2) - fy(1)) <= 1e-6_dp * fy(1) .and. &
                abs(lost(2) - lost(1)) <= 1e-6_dp * lost(1) .and. lost(1) > 0, 'rsccpy: a copied friction has its path')
    call delete(copy)
    call delete(ifri)
    call delete(icon)
    call delete(iasp)
    call delete(icase)
  end subroutine

  ! Every routine with a handle of another kind, of nothing, of a negative number and of what was deleted, in each place of a handle.
  subroutine handles()
    integer :: icase, isurf, iasp, icon, ifri, many(100), k, n, gone, bad(3), out, i4(4)
    integer :: wrong(8)
    real(dp) :: z(3, 3), v(8), x(1)
    character(30) :: text
    scene = 'own'
    z = 0
    z(2, 2) = 0.125_dp
    x = 1
    call rsccas(icase, ierr)
    call rscsur(isurf, 3, 3, 1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0, z, ierr)
    call rscfnd(iasp, isurf, 0, ierr)
    call rsccon(icon, iasp, 1e3_dp, 4.0_dp, 1.0_dp, 1.0_dp, 0, ierr)
    call rscfri(ifri, icon, 0, ierr)
    call rsccas(gone, ierr)
    k = gone
    call delete(gone)
    bad = [k, -1, 1000000]
    out = -7
    wrong = [bad, isurf, iasp, icon, ifri, -5]
    do n = 1, 8
      k = wrong(n)
      call rscred(k, '&run /', ierr)
      call no_handle(1, 'rscred')
      call rscset(k, 'surface%n', '8', ierr)
      call no_handle(1, 'rscset')
      call rscget(k, 'surface%n', text, ierr)
      call no_handle(1, 'rscget')
      call rscrun(k, out, ierr)
      call no_handle(1, 'rscrun')
      said = merge(0, said, n == 1)
      call rscsyn(out, k, 1, ierr)
      call no_handle(2, 'rscsyn')
      call rscfnd(out, isurf, k, ierr)
      call no_handle(3, 'rscfnd')
      call rscmak(out, k, 1, ierr)
      call no_handle(2, 'rscmak')
      call rsccon(out, iasp, 1e3_dp, 4.0_dp, 1.0_dp, 1.0_dp, k, ierr)
      call no_handle(7, 'rsccon')
      call rsccnc(out, iasp, k, ierr)
      call no_handle(3, 'rsccnc')
      call rscfri(out, icon, k, ierr)
      call no_handle(3, 'rscfri')
    end do
    wrong = [0, bad, icase, iasp, icon, ifri]
    do n = 1, 8
      call rscfnd(out, wrong(n), 0, ierr)
      call no_handle(2, 'rscfnd')
      call rschgt(wrong(n), 9, z, ierr)
      call no_handle(1, 'rschgt')
    end do
    wrong = [0, bad, icase, isurf, icon, ifri]
    do n = 1, 8
      k = wrong(n)
      call rscnum(k, out, ierr)
      call no_handle(1, 'rscnum')
      call rscxyz(k, 1, x, x, x, x, ierr)
      call no_handle(1, 'rscxyz')
      call rsccon(out, k, 1e3_dp, 4.0_dp, 1.0_dp, 1.0_dp, 0, ierr)
      call no_handle(2, 'rsccon')
      call rsccnc(out, k, 0, ierr)
      call no_handle(2, 'rsccnc')
    end do
    wrong = [0, bad, icase, isurf, iasp, ifri]
    v = -7
    i4 = -7
    do n = 1, 8
      k = wrong(n)
      call rsctip(k, 1.0_dp, 1.0_dp, ierr)
      call no_handle(1, 'rsctip')
      call rsctch(k, v(1), ierr)
      call no_handle(1, 'rsctch')
      call rscind(k, 0.0_dp, v(2), ierr)
      call no_handle(1, 'rscind')
      call rscprs(k, 1.0_dp, v(3), ierr)
      call no_handle(1, 'rscprs')
      call rscres(k, v(1), v(2), v(3), i4(1), ierr)
      call no_handle(1, 'rscres')
      call rsclev(k, i4(1), i4(2), i4(3), i4(4), v(1), ierr)
      call no_handle(1, 'rsclev')
      call rscstf(k, v(4), ierr)
      call no_handle(1, 'rscstf')
      call rscnrg(k, v(5), ierr)
      call no_handle(1, 'rscnrg')
      call rscspt(k, 1, i4(1:1), v(1:1), v(2:2), v(3:3), ierr)
      call no_handle(1, 'rscspt')
      call rscdfl(k, 1, x, x, v(1:1), ierr)
      call no_handle(1, 'rscdfl')
      call rscfri(out, k, 0, ierr)
      call no_handle(2, 'rscfri')
    end do
    wrong = [0, bad, icase, isurf, iasp, icon]
    do n = 1, 8
      k = wrong(n)
      call rscupd(k, 0.0_dp, 0.0_dp, 0.0_dp, v(6), v(7), v(8), v(1), ierr)
      call no_handle(1, 'rscupd')
      call rsccmt(k, ierr)
      call no_handle(1, 'rsccmt')
      call rscrbk(k, ierr)
      call no_handle(1, 'rscrbk')
    end do
    do n = 1, 3
      k = bad(n)
      call rscdel(k, ierr)
      said = merge(0, said, n == 1)
      call no_handle(1, 'rscdel')
      call expect(k == bad(n), 'rscdel: the handle after a failure')
    end do
    wrong = [0, bad, -5, -6, -7, -8]
    do n = 1, 8
      call rsccpy(out, wrong(n), ierr)
      call no_handle(2, 'rsccpy')
    end do
    call expect(out == -7 .and. all(i4 == -7) .and. all(abs(v + 7) <= 0), 'outputs after refused handles')
    k = 0
    call rscdel(k, ierr)
    call expect(ierr == 0, 'rscdel of nothing')
    ! A message of the table is gone with the next call; a handle is free again when it was deleted; the table grows.
    call rscind(icon, nan, v(1), ierr)
    call rscmsg(text)
    call expect(ierr == -2 .and. text == 'argument 2 (separation) must b', 'rscmsg after another failure: ' // text)
    do k = 1, 100
      many(k) = 0
      call rsccas(many(k), ierr)
      call expect(ierr == 0 .and. many(k) > 0 .and. count(many(:k) == many(k)) == 1, 'rsccas: a handle of its own')
      write (text, '(i0)') k
      call rscset(many(k), 'run%realizations', text, ierr)
      call expect(ierr == 0, 'rscset of many')
    end do
    do k = 100, 1, -1
      call rscget(many(k), 'run%realizations', text, ierr)
      read (text, *) n
      call expect(ierr == 0 .and. n == k, 'rscget of many')
    end do
    k = many(40)
    call delete(many(40))
    call rsccas(n, ierr)
    call expect(n == k, 'a handle is used again')
    many(40) = n
    do k = 1, 100
      call delete(many(k))
    end do
    call delete(ifri)
    call delete(icon)
    call delete(iasp)
    call delete(isurf)
    call delete(icase)
  end subroutine
end program
