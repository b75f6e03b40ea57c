! A steel ball set down on a rough table with a velocity and a backspin slides, rolls and comes to
! rest: separation, position and rotation of the ball by the velocity Verlet method, with the normal
! and the tangential force of one contact. The angular momentum of the backspin about the point of
! contact balances that of the velocity, so that both end at the same time; then the ball oscillates
! on the tangential stiffness, damped by microslip. The sum of kinetic, elastic and potential energy
! and friction work must be constant. The ball moves some 20 micrometres, over which the asperities
! under it are assumed not to change. Units: mm, N, s, hence t (1000 kg) for masses and N mm for
! energies.
program rolling
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double
  implicit none
  real(dp), parameter :: pi = acos(-1.0_dp), g = 9.81e3_dp, R = 2.5_dp, mu = 0.3_dp
  real(dp), parameter :: mass = 7.8e-9_dp * 4 / 3.0_dp * pi * R**3, inertia = 0.4_dp * mass * R**2
  real(dp), parameter :: speed = 10
  real(dp), parameter :: tolerance = 1.0e-6_dp  ! of the energy at the beginning
  type(rsc_case) :: options
  type(rsc_asperities) :: asperities
  type(rsc_contact) :: contact
  type(rsc_friction) :: friction
  real(dp) :: dt, time, z, x, angle, v, u, spin, N, Q, lost, normal, tangential, energy, start, &
      worst
  integer :: step, steps
  character(len=20) :: argument

  steps = 30000  ! 7 ms
  call get_command_argument(1, argument)
  if (argument /= '') read (argument, *) steps
  call options%read('&surface n=256, L_lambda_l=8, L_lambda_s=64, sigma=1.0e-3 / ' // &
                    '&solids E=210d3, 210d3, nu=0.3, 0.3, R=Infinity, 2.5, friction=0.3 /' // &
                    ' &solver model=''asperities'', tolerance=1d-11 / &asperities law=''hertz'' /')
  call asperities%make(options)
  call contact%create_from_case(asperities, options)
  call friction%create_from_case(contact, options)

  ! deeper than in equilibrium, so that the ball also oscillates vertically
  call contact%press(1.5_dp * mass * g, z)
  x = 0
  angle = 0
  v = 0
  u = speed
  spin = -mass * R * speed / inertia
  call evaluate()
  start = energy
  worst = 0
  print '(a)', '  time [ms]   velocity   spin R [mm/s]    N [mN]    Q [mN]   lost/beginning'
  time = 0
  do step = 1, steps
    ! initially all spots stick, and friction builds up in microseconds
    dt = merge(5.0e-9_dp, 2.5e-7_dp, step <= 1000)
    time = time + dt
    v = v + 0.5_dp * dt * (N / mass - g)
    u = u - 0.5_dp * dt * Q / mass
    spin = spin + 0.5_dp * dt * R * Q / inertia
    z = z + dt * v
    x = x + dt * u
    angle = angle + dt * spin
    call evaluate()
    v = v + 0.5_dp * dt * (N / mass - g)
    u = u - 0.5_dp * dt * Q / mass
    spin = spin + 0.5_dp * dt * R * Q / inertia
    call add_up()
    worst = max(worst, abs(energy - start))
    if (mod(step, max(1, steps / 10)) == 0) then
      print '(f9.3,2f14.6,2f11.5,f14.8)', 1e3_dp * time, u, spin * R, 1e3_dp * N, 1e3_dp * Q, &
          lost / start
    end if
  end do
  print '(a,es9.2,a)', 'energy is kept to', worst / start, ' of that at the beginning'
  if (.not. worst <= tolerance * start) error stop 'the energy is not kept'
  if (steps >= 30000 .and. .not. (abs(u) < 0.02_dp * speed .and. abs(spin * R) < 0.05_dp * speed)) &
      error stop 'the ball is not at rest'
  if (.not. abs(mass * R * u + inertia * spin) < 1e-12_dp * mass * R * speed) then
    error stop 'momentum about the contact is not kept'
  end if

contains

  ! The slide is the displacement of the lowest point of the ball relative to the table, zero in
  ! rolling.
  subroutine evaluate()
    call friction%update(z, x - R * angle, 0.0_dp, force=N, force_x=Q)
    call add_up()
  end subroutine

  subroutine add_up()
    call friction%state(energy=normal, tangential_energy=tangential, lost=lost)
    energy = 0.5_dp * (mass * (v**2 + u**2) + inertia * spin**2) + mass * g * z + normal + &
        tangential + lost
  end subroutine
end program
