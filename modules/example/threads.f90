! Many spheres on one surface, distributed among OpenMP threads: one contact per thread, all on the
! same asperities. Every thread moves its own sphere to several positions; the results do not depend
! on the distribution.
program threads
  use rsc
  use omp_lib
  use, intrinsic :: iso_c_binding, only: dp => c_double
  implicit none
  integer, parameter :: places = 64
  real(dp), parameter :: load = 1.0_dp
  type(rsc_case) :: options
  type(rsc_asperities) :: asperities
  real(dp) :: alone(places), together(places), area(places)
  integer :: most

  call options%read('&surface n=512, L_lambda_l=16, L_lambda_s=128, sigma=0.005 / ' // &
      '&solids R=Infinity, 0.5 / &solver model=''asperities'', tolerance=1e-9 /')
  call asperities%make(options)
  most = max(4, omp_get_max_threads())
  call work(1, alone)
  call work(most, together)
  print '(a,i0,a,f0.6,a,f0.6,a)', 'mean separation under 1 N at ', places, ' places: ', &
      sum(together) / places, ' mm, mean area ', sum(area) / places, ' mm2'
  print '(a,es9.2)', 'largest difference between one thread and several: ', &
      maxval(abs(together - alone))
  if (.not. maxval(abs(together - alone)) < 1e-8_dp) error stop 'the threads disagree'
  if (.not. (maxval(alone) - minval(alone) > 1e-4_dp)) error stop 'all places are alike'

contains

  subroutine work(n_threads, separation)
    integer, intent(in) :: n_threads
    real(dp), intent(out) :: separation(:)
    type(rsc_contact), allocatable :: contact(:)
    integer :: k, mine
    allocate (contact(n_threads))
    do k = 1, n_threads
      call contact(k)%create_from_case(asperities, options)
    end do
    !$omp parallel do num_threads(n_threads) private(mine) schedule(dynamic)
    do k = 1, places
      mine = omp_get_thread_num() + 1
      call contact(mine)%move_tip(0.2_dp + 0.6_dp * mod(k - 1, 8) / 7, &
                                  0.2_dp + 0.6_dp * ((k - 1) / 8) / 7)
      call contact(mine)%press(load, separation(k))
      area(k) = contact(mine)%area()
    end do
    !$omp end parallel do
    do k = 1, n_threads
      call contact(k)%free()
    end do
  end subroutine
end program
