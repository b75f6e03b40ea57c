! The Stribeck curve of a slider with a rough face, from full film to contact: Reynolds' equation
! with the flow factors and the contact pressure of an interface, whose law was computed by rsc:
!
!     rsc input/lubrication.nml
!     law.py output/lubrication.nc --lubrication -o steel.law
!     bearing steel.law
!
! The smooth lower face moves with the velocity U along x; the rough upper face of length L is
! inclined, and the mean gap falls by `fall` to g at the trailing edge. The slider is infinitely
! wide. Flux per width q = -(K/eta) dP/dx + S U with K = phi_p h^3/12 and S = phi_c h/2 of the local
! mean gap h, the same everywhere; P = 0 at both edges. The load is that of the film and of the
! contacts; the friction is mu times the contact pressure, and the shear of the film eta U/h + S
! dP/dx (S also gives the shear of a pressure flow; eta U/h is that of a parallel gap).
!
! Prints for each eta U over the load: the gap at the trailing edge, the share of the load that the
! contacts carry, and the coefficient of friction. Checks both ends: the closed form of smooth
! faces in a thick film, and mu in dry contact.
program bearing
  use rsc_law
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  integer, parameter :: n = 2000       ! points along the slider
  real(real64), parameter :: length = 1.0_real64, fall = 2.0e-3_real64, mu = 0.12_real64
  real(real64), parameter :: load = 5.0_real64  ! per width
  type(law) :: interface
  character(300) :: file
  real(real64) :: speed, gap, share, friction, film, shear, last_share
  integer :: k
  call get_command_argument(1, file)
  call interface%read(file)
  print '(a)', '# eta U/load  gap at the trailing edge  share of contact  friction'
  last_share = 0
  do k = 0, 30  ! eta U over the load, thick films first
    speed = load*10.0_real64**(-2 - 0.25_real64*k)
    call trailing_gap(speed, gap)
    call forces(speed, gap, film, share, friction, shear)
    if (share < last_share) error stop 'the contacts carry less at a lower speed'
    last_share = share
    print '(4es16.7)', speed/load, gap, share/load, friction
    if (k == 0) call check_thick_film(speed, gap, film, shear)
  end do
  if (abs(friction/mu - 1) > 1.0e-3 .or. share/load < 0.999) error stop 'it is not dry at rest'

contains
  !> The gap at which film and contacts carry the load, by bisection.
  subroutine trailing_gap(speed, gap)
    real(real64), intent(in) :: speed
    real(real64), intent(out) :: gap
    real(real64) :: low, high, film, share, friction, shear
    integer :: k
    low = 1.0e-7_real64
    high = 1
    do k = 1, 60
      gap = sqrt(low*high)
      call forces(speed, gap, film, share, friction, shear)
      if (film + share > load) then
        low = gap
      else
        high = gap
      end if
    end do
  end subroutine

  !> What the film and the contacts carry, the coefficient of friction, and the shear of the film,
  !> by the midpoint rule.
  subroutine forces(speed, gap, film, share, friction, shear)
    real(real64), intent(in) :: speed, gap
    real(real64), intent(out) :: film, share, friction, shear
    real(real64), dimension(n) :: h, phi_p, phi_c, contact, K, S, slope
    real(real64) :: flux, P, dx
    integer :: i
    dx = length/n
    h = [(gap + fall*(1 - (i - 0.5_real64)/n), i=1, n)]
    call interface%evaluate('flow_factor_pressure_x', 1, h, phi_p)
    call interface%evaluate('flow_factor_sliding_x', 1, h, phi_c)
    call interface%evaluate('pressure', 1, h, contact)
    K = max(phi_p*h**3/12, tiny(1.0_real64))  ! closed: nothing flows
    S = phi_c*h/2
    ! The resistances 1/K in units of the largest, which may be infinitely large beside the others.
    associate (relative => minval(K)/K)
      flux = sum(S*relative)/sum(relative)
      slope = speed*(S - flux)/K
    end associate
    film = 0
    P = 0
    do i = 1, n
      film = film + (P + slope(i)*dx/2)*dx
      P = P + slope(i)*dx
    end do
    share = sum(contact)*dx
    shear = sum(speed/h + S*slope)*dx
    friction = (shear + mu*share)/max(film + share, tiny(1.0_real64))
  end subroutine

  !> The infinitely wide slider of smooth faces, with k = fall/g: load 6 eta U (L/g)^2 [ln(1 + k)
  !> /k^2 - 2/(k (2 + k))], shear eta U (L/g) [4 ln(1 + k)/k - 6/(2 + k)]. Flow factors of thick
  !> films are 1 - O((sigma/h)^2).
  subroutine check_thick_film(speed, gap, film, shear)
    real(real64), intent(in) :: speed, gap, film, shear
    real(real64) :: k, smooth, smooth_shear
    k = fall/gap
    smooth = 6*speed*(length/gap)**2*(log(1 + k)/k**2 - 2/(k*(2 + k)))
    smooth_shear = speed*length/gap*(4*log(1 + k)/k - 6/(2 + k))
    print '(a, 2es12.4)', '# thick film over smooth faces: load, shear', film/smooth, &
      shear/smooth_shear
    if (abs(film/smooth - 1) > 0.02 .or. abs(shear/smooth_shear - 1) > 0.02) &
      error stop 'a thick film is not that of smooth faces'
  end subroutine
end program
