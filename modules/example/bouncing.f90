! A steel ball dropped on a rough surface bounces, by the velocity Verlet method. The contact is
! conservative, as is the method on average: the sum of kinetic, elastic and potential energy must
! be constant over many bounces. Argument: the number of bounces, default 100. Units: mm, N, s,
! hence t (1000 kg) for masses and N mm for energies.
program bouncing
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double
  implicit none
  real(dp), parameter :: pi = acos(-1.0_dp), g = 9.81e3_dp, R = 2.5_dp
  real(dp), parameter :: mass = 7.8e-9_dp * 4 / 3.0_dp * pi * R**3, drop = 1.0e-3_dp
  real(dp), parameter :: tolerance = 1.0e-6_dp  ! of the energy of the drop
  type(rsc_case) :: options
  type(rsc_asperities) :: asperities
  type(rsc_contact) :: contact
  real(dp) :: z, v, a, force, touch, energy, start, worst, dt, deepest
  integer :: done, steps, bounces
  logical :: touching
  character(len=20) :: argument

  bounces = 100
  call get_command_argument(1, argument)
  if (argument /= '') read (argument, *) bounces

  call options%read('&solver model=''asperities'' / ' // &
      '&surface n=256, L_lambda_l=8, L_lambda_s=64, sigma=1.0e-3 / ' // &
      '&solids E=210d3, 210d3, nu=0.3, 0.3, R=Infinity, 2.5 / &asperities law=''hertz'' /')
  call options%set('solver%tolerance', 1.0e-10_dp)
  call asperities%make(options)
  call contact%create_from_case(asperities, options)

  touch = contact%first_touch()
  z = touch + drop
  v = 0
  call evaluate()
  call evaluate_energy()
  start = energy
  worst = 0
  deepest = z
  done = 0
  steps = 0
  touching = .false.
  do while (done < bounces)
    ! Free flight has no error; a contact lasts some 110 microseconds.
    dt = merge(2.0e-8_dp, 1.0e-6_dp, z < touch + 1.0e-4_dp)
    v = v + 0.5_dp * dt * a
    z = z + dt * v
    call evaluate()
    v = v + 0.5_dp * dt * a
    call evaluate_energy()
    worst = max(worst, abs(energy - start))
    deepest = min(deepest, z)
    if (touching .and. force <= 0) done = done + 1
    touching = force > 0
    steps = steps + 1
  end do
  print '(i0,a,i0,a)', done, ' bounces in ', steps, ' steps'
  print '(a,es10.3,a)', 'deepest penetration below first touch ', touch - deepest, ' mm'
  print '(a,es10.3,a)', 'largest change of the total energy     ', worst / (mass * g * drop), &
      ' of that of the drop'
  if (.not. worst <= tolerance * mass * g * drop) error stop 'the total energy is not kept'

contains

  subroutine evaluate()
    call contact%indent(z, force)
    a = force / mass - g
  end subroutine

  subroutine evaluate_energy()
    energy = 0.5_dp * mass * v**2 + mass * g * (z - touch) + contact%energy()
  end subroutine
end program
