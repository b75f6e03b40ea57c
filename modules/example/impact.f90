! The coefficient of restitution of a steel ball against its speed: one impact at each speed on a
! new rough surface whose asperities yield, by the velocity Verlet method. The sum of kinetic
! energy, elastic energy and plastic work must be constant, so that the final energy is the initial
! energy minus the plastic work. Slow balls bounce back from elastic asperities; faster ones flatten
! them and lose most of their energy; the fastest compress the smooth sphere, which stays elastic
! here. Argument: the number of speeds, from the slowest on, default all. Units: mm, N, s, hence t
! (1000 kg) for masses and N mm for energies.
program impact
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double
  implicit none
  real(dp), parameter :: pi = acos(-1.0_dp), R = 2.5_dp, mass = 7.8e-9_dp * 4 / 3.0_dp * pi * R**3
  real(dp), parameter :: speeds(*) = [1.0_dp, 3.0_dp, 10.0_dp, 30.0_dp, 100.0_dp, 300.0_dp]
  ! distance per step at 1 mm/s, where the depth is some 5e-5 mm [mm]
  real(dp), parameter :: step = 1.2e-7_dp
  real(dp), parameter :: tolerance = 1.0e-5_dp  ! of the initial energy
  type(rsc_case) :: options
  type(rsc_asperities) :: asperities
  type(rsc_contact) :: contact
  real(dp) :: z, v, dt, force, touch, coming, lost, worst, deepest, largest
  integer :: k, many
  character(len=20) :: argument

  many = size(speeds)
  call get_command_argument(1, argument)
  if (argument /= '') read (argument, *) many
  call options%read('&surface n=256, L_lambda_l=8, L_lambda_s=64, sigma=1.0e-3 / ' // &
                    '&solids E=210d3, 210d3, nu=0.3, 0.3, R=Infinity, 2.5, hardness=2.0d3 /' // &
                    ' &asperities law=''hertz'' /' // &
                    ' &solver model=''asperities'', tolerance=1d-10 /')
  call asperities%make(options)
  print '(a)', '  speed [mm/s]   restitution   deepest [um]   largest force [N]' // &
      '   plastic work/energy   energy kept to'
  do k = 1, many
    call contact%create_from_case(asperities, options)
    touch = contact%first_touch()
    z = touch
    v = -speeds(k)
    coming = 0.5_dp * mass * v**2
    ! the depth is proportional to the speed to the power of about 4/5
    dt = step * speeds(k)**0.8_dp / speeds(k)
    deepest = z
    largest = 0
    worst = 0
    force = 0
    do
      v = v + 0.5_dp * dt * force / mass
      z = z + dt * v
      call contact%indent(z, force)
      v = v + 0.5_dp * dt * force / mass
      lost = contact%value('plastic_work')
      worst = max(worst, abs(0.5_dp * mass * v**2 + contact%energy() + lost - coming))
      deepest = min(deepest, z)
      largest = max(largest, force)
      if (v > 0 .and. force <= 0) exit
    end do
    print '(f14.1,f14.4,f15.4,f20.4,f22.4,es17.1)', speeds(k), v / speeds(k), &
        1e3_dp * (touch - deepest), largest, lost / coming, worst / coming
    if (.not. worst <= tolerance * coming) error stop 'the energy is not kept'
    if (.not. (lost >= 0 .and. lost < coming)) then
      error stop 'the plastic work is not between nothing and all'
    end if
    if (.not. abs((v / speeds(k))**2 - (1 - lost / coming)) <= tolerance) then
      error stop 'the ball does not leave with what is left'
    end if
  end do
end program
