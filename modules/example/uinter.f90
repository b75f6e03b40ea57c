! An interface law of rsc for Abaqus: user subroutine UINTER, pressure of rough flats against
! overclosure. No friction, no heat. Properties (*SURFACE INTERACTION, USER, PROPERTIES=n):
!     0, c1, p1, c2, p2, ...    a table, overclosure and pressure, both increasing:
!                               output/export/law.py RESULT.nc --abaqus writes these lines
!     1, A, Z0                  rsc itself: the case is read from the file rsc.nml in the working
!                               folder; pressure is force over the nominal area A, overclosure c
!                               is the separation Z0 - c. One contact serves all points, one call
!                               at a time
! Beyond the last point of a table the last segment is continued. Units are those of the deck and of
! the law. Compile with the module rsc (pkg-config --cflags --libs rsc_fortran).
module rough_interface
  use rsc
  implicit none
  private
  public :: from_table, from_rsc
  integer, parameter :: dp = kind(1.0d0)
  type(rsc_asperities), save :: asperities
  type(rsc_contact), save :: contact
  logical, save :: ready = .false.

contains

  ! Pressure p and its slope dp/dc at the overclosure c by linear interpolation of the pairs (c1,
  ! p1, c2, p2, ...); 0 before the first.
  pure subroutine from_table(pairs, c, p, slope)
    real(dp), intent(in) :: pairs(:), c
    real(dp), intent(out) :: p, slope
    integer :: k, n, low, high
    n = size(pairs) / 2
    p = 0
    slope = 0
    if (n < 2) return
    if (c <= pairs(1)) return
    low = 1
    high = n
    do while (high - low > 1)
      k = (low + high) / 2
      if (pairs(2*k - 1) <= c) then
        low = k
      else
        high = k
      end if
    end do
    slope = (pairs(2*low + 2) - pairs(2*low)) / (pairs(2*low + 1) - pairs(2*low - 1))
    p = pairs(2*low) + slope * (c - pairs(2*low - 1))
  end subroutine

  ! Pressure and slope from a contact of rsc at the separation Z0 - c, over the nominal area.
  subroutine from_rsc(area, Z0, c, p, slope)
    real(dp), intent(in) :: area, Z0, c
    real(dp), intent(out) :: p, slope
    type(rsc_case) :: options
    integer :: unit, length
    character(:), allocatable :: text
    !$omp critical (rough_interface_of_rsc)
    if (.not. ready) then
      open (newunit=unit, file='rsc.nml', access='stream', status='old', action='read')
      inquire (unit, size=length)
      allocate (character(length) :: text)
      read (unit) text
      close (unit)
      call options%read(text)
      call asperities%make(options)
      call contact%create_from_case(asperities, options)
      call options%free()
      ready = .true.
    end if
    call contact%indent(Z0 - c, p)
    p = p / area
    slope = -contact%stiffness() / area
    !$omp end critical (rough_interface_of_rsc)
  end subroutine
end module

subroutine uinter(stress, ddsddr, dviscous, dstructural, flux, ddfddt, ddsddt, ddfddr, statev, &
                  sed, sfd, spd, svd, scd, pnewdt, rdisp, drdisp, temp, dtemp, predef, dpred, &
                  time, dtime, freqr, ciname, slname, msname, props, coords, alocaldir, drot, &
                  area, chrlngth, node, ndir, nstatv, npred, nprops, mcrd, kstep, kinc, kit, &
                  linper, lopenclose, lstate, lsdi, lprint)
  use rough_interface
  implicit none
  integer, parameter :: dp = kind(1.0d0)
  integer :: node, ndir, nstatv, npred, nprops, mcrd, kstep, kinc, kit, linper, lopenclose, &
      lstate, lsdi, lprint
  real(dp) :: stress(ndir), ddsddr(ndir, ndir), dviscous(ndir, ndir), dstructural(ndir, ndir), &
      flux(2), ddfddt(2, 2), ddsddt(ndir, 2), ddfddr(2, ndir), statev(nstatv), sed, sfd, spd, svd, &
      scd, pnewdt, rdisp(ndir), drdisp(ndir), temp(2), dtemp(2), predef(2, npred), &
      dpred(2, npred), time(2), dtime, freqr, props(nprops), coords(mcrd), alocaldir(3, 3), &
      drot(2, 2), area, chrlngth
  character(80) :: ciname, slname, msname
  stress = 0
  ddsddr = 0
  ! rdisp(1) is positive in overclosure, and a positive stress presses.
  if (props(1) < 0.5_dp) then
    call from_table(props(2:), rdisp(1), stress(1), ddsddr(1, 1))
  else
    call from_rsc(props(2), props(3), rdisp(1), stress(1), ddsddr(1, 1))
  end if
  lopenclose = merge(1, 0, stress(1) > 0)
end subroutine
