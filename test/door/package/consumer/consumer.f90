! The same from Fortran.
program consumer
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double
  implicit none
  type(rsc_case) :: options
  type(rsc_asperities) :: asperities
  type(rsc_contact) :: contact
  real(dp), parameter :: E = 1.0e5_dp, u = 1.0e-3_dp
  real(dp) :: N, Z0
  real(dp), allocatable :: force(:)
  character(200) :: errmsg, version
  integer :: stat

  call get_command_argument(1, version)
  if (rsc_library_version() /= version) error stop 'version'
  call asperities%take([0.0_dp], [0.0_dp], [0.0_dp], [0.5_dp])
  call contact%create(asperities, E, 10.0_dp, 0.0_dp, 0.0_dp)
  call contact%indent(-u, N)
  if (abs(N / (4 / 3.0_dp * E * sqrt(0.5_dp) * u**1.5_dp) - 1) > 1e-12_dp) &
    error stop 'the force of Hertz'
  call contact%press(-1.0_dp, stat=stat, errmsg=errmsg)
  if (stat /= -2 .or. index(errmsg, 'force') == 0) error stop 'a negative force'
  call options%read('&solver model=''asperities'' / ' // &
    '&surface n=256 L_lambda_l=4 L_lambda_s=64 /')
  call asperities%make(options)
  call contact%create_from_case(asperities, options)
  call contact%press(10.0_dp, Z0)
  allocate (force(asperities%count()))
  call contact%per_asperity(force)
  if (abs(sum(force) - 10) > 1e-4_dp) error stop 'the force asked for'
  deallocate (force)  ! a program's own variables outlive it otherwise
  print '(a)', 'consumer: all is well'
end program
