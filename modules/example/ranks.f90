! Each rank of an MPI program has its own patch of a rough plate, with a separate surface, under one
! flat rigid punch with a given load. The ranks determine the common separation at which the sum of
! their forces equals the load.
program ranks
  use mpi
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double
  implicit none
  real(dp), parameter :: load_per_patch = 20.0_dp
  type(rsc_case) :: options
  type(rsc_asperities) :: patch
  type(rsc_contact) :: contact
  real(dp) :: mine(2), all(2), Z0, load, touch, highest, low, high, check
  integer :: rank, size, error, k

  call mpi_init(error)
  call mpi_comm_rank(mpi_comm_world, rank, error)
  call mpi_comm_size(mpi_comm_world, size, error)
  load = size * load_per_patch

  call options%read('&surface n=256, L_lambda_l=8, L_lambda_s=64, sigma=0.005 /' // &
                    ' &solids R=2*Infinity / &solver model=''asperities'', tolerance=1e-10 /')
  call patch%make(options, realization=rank + 1)
  call contact%create_from_case(patch, options)
  touch = contact%first_touch()
  call mpi_allreduce(touch, highest, 1, mpi_double_precision, mpi_max, mpi_comm_world, error)

  ! Newton's method on N(Z0) - load, bracketed by separations with a smaller and a larger force.
  high = highest
  low = -huge(low)
  Z0 = highest - 0.001_dp
  do k = 1, 60
    call contact%indent(Z0)
    mine = [contact%force(), contact%stiffness()]
    call mpi_allreduce(mine, all, 2, mpi_double_precision, mpi_sum, mpi_comm_world, error)
    if (abs(all(1) - load) <= 1e-8_dp * load) exit
    if (all(1) < load) then
      high = Z0
    else
      low = Z0
    end if
    Z0 = Z0 + (load - all(1)) / all(2)
    if (Z0 >= high .or. Z0 <= low) Z0 = 0.5_dp * (max(low, high - 1) + high)
  end do
  print '(a,i0,a,f10.6,a,f10.5,a,i0)', 'rank ', rank, ': force ', contact%force(), ' N, area ', &
      contact%area(), ' mm2, contacts ', contact%contacts()
  check = contact%force()
  call mpi_allreduce(check, all(1), 1, mpi_double_precision, mpi_sum, mpi_comm_world, error)
  if (rank == 0) print '(a,f12.8,a,f12.6,a)', 'together at ', Z0, ' mm: ', all(1), ' N'
  if (.not. abs(all(1) - load) <= 1e-6_dp * load) error stop 'the load is not reached'
  if (size > 1 .and. abs(check - load_per_patch) < 1e-9_dp) error stop 'the patches are all alike'
  call mpi_finalize(error)
end program
