! rsc_results reads what rsc wrote: `test_results ONE MANY OTHER`, results of one and of three realizations made from known numbers,
! and a file that is none.
program test_results
  use, intrinsic :: iso_fortran_env, only: real64
  use rsc_results
  implicit none
  integer, parameter :: asperities = 6000, steps = 12, points = 64
  real(real64), parameter :: pi = acos(-1.0_real64), sigma = 0.01_real64
  integer :: failures = 0

  call test_one(argument(1))
  call test_many(argument(2))
  call test_refusals(argument(3))
  if (failures > 0) error stop 1
  print '(a)', 'rsc_results: everything read as written'

contains

  function argument(i) result(text)
    integer, intent(in) :: i
    character(:), allocatable :: text
    integer :: length
    call get_command_argument(i, length=length)
    allocate (character(length) :: text)
    call get_command_argument(i, text)
  end function argument

  subroutine check(ok, what)
    logical, intent(in) :: ok
    character(*), intent(in) :: what
    if (ok) return
    failures = failures + 1
    print '(2a)', 'failed: ', what
  end subroutine check

  logical function near(a, b, tolerance)
    real(real64), intent(in) :: a, b, tolerance
    near = abs(a - b) <= tolerance * abs(b)
  end function near

  subroutine test_one(file)
    character(*), intent(in) :: file
    type(rsc_result) :: r
    real(real64) :: cell
    integer :: s, first, last, i

    call rsc_read_result(file, r)
    call check(r%title == 'A made-up result', 'title')
    call check(r%case == "&run title='A made-up result' /" // new_line('a'), 'case')
    call check(r%seed == 1, 'seed')
    call check(r%realizations() == 1 .and. r%steps() == steps, 'number of realizations and steps')
    call check(all(shape(r%map_pressure) == [20, 20, steps]), 'shape of the map')
    call check(all(shape(r%height) == [points, points - 4]), 'shape of the heights')
    call check(size(r%asperity_x) == asperities .and. size(r%asperity_biharmonic) == 0, 'asperities')

    ! Known by formula.
    do i = 1, asperities, 97
      call check(near(r%asperity_x(i), (i - 0.5_real64) / asperities, 1e-14_real64), 'asperity_x')
      call check(near(r%asperity_y(i), modulo(i * 0.6180339887498949_real64, 1.0_real64), 1e-10_real64), 'asperity_y')
    end do
    call check(near(r%separation(1, 1), 4 * sigma, 1e-14_real64), 'first separation')
    call check(near(r%separation(steps, 1), sigma, 1e-14_real64), 'last separation')
    ! x is the first index, y the second: point (8, 4) is at i = 7, j = 3.
    call check(near(r%height(8, 4), sigma * (sin(2.1_real64) + 0.5_real64 * cos(0.6_real64)) + 7e-4_real64, 1e-13_real64), 'height')
    call check(near(r%e_star, 1000.0_real64, 1e-15_real64) .and. near(r%r_star, 10.0_real64, 1e-15_real64), 'E* and R*')
    call check(r%status(steps, 1) == 2 .and. all(r%iterations(:, 1) == [(s, s = 0, steps - 1)]), 'status and iterations')
    call check(all(r%beyond_law(:, 1) == [(2 * s, s = 0, steps - 1)]), 'beyond_law')
    call check(all(rsc_is_absent(r%force_std)), 'no deviation over one realization')

    ! The contacts of a level carry its force and its area; the cells of the map do too.
    cell = r%x(2) - r%x(1)
    do s = 1, steps
      first = r%contact_start(s)
      last = first + r%contact_count(s) - 1
      call check(r%contact_count(s) == r%contacts(s, 1), 'contacts of a level')
      call check(near(sum(r%contact_force(first:last)), r%force(s, 1), 1e-13_real64), 'force of the contacts')
      call check(near(sum(pi * r%contact_radius(first:last)**2), r%contact_area(s, 1), 1e-13_real64), 'area of the contacts')
      call check(near(sum(r%map_pressure(:, :, s)) * cell**2, r%force(s, 1), 1e-12_real64), 'force of the map')
    end do
    ! The contact with the largest force of the last level is in the cell that its asperity's place says.
    i = first - 1 + maxloc(r%contact_force(first:last), 1)
    associate (x => r%asperity_x(r%contact_asperity(i)), y => r%asperity_y(r%contact_asperity(i)))
      call check(r%map_pressure(int(x / cell) + 1, int(y / cell) + 1, steps) * cell**2 &
                 >= r%contact_force(i) * (1 - 1e-12_real64), 'place in the map')
    end associate
  end subroutine test_one

  subroutine test_many(file)
    character(*), intent(in) :: file
    type(rsc_result) :: r
    real(real64) :: mean
    integer :: s
    call rsc_read_result(file, r)
    call check(r%realizations() == 3 .and. all(r%realization == [1, 2, 3]), 'three realizations')
    call check(size(r%asperity_x) == 0 .and. size(r%contact_start) == 0, 'no contacts kept of single realizations')
    call check(size(r%height) == 0, 'no heights kept of single realizations')
    do s = 1, steps
      mean = sum(r%force(s, :)) / 3
      call check(near(r%force_mean(s), mean, 1e-14_real64), 'mean force')
      call check(near(r%force_std(s), sqrt(sum((r%force(s, :) - mean)**2) / 2), 1e-12_real64), 'deviation of the force')
    end do
    call check(near(r%m2(3), 0.023_real64, 1e-14_real64), 'm2')
  end subroutine test_many

  subroutine test_refusals(other)
    character(*), intent(in) :: other
    type(rsc_result) :: r
    character(:), allocatable :: message
    integer :: stat
    call rsc_read_result('no/such/file.nc', r, stat, message)
    call check(stat /= 0 .and. index(message, "no/such/file.nc': No such file") > 0, 'missing file: ' // message)
    call rsc_read_result(other, r, stat, message)
    call check(stat /= 0 .and. index(message, other) > 0, 'not NetCDF: ' // message)
  end subroutine test_refusals

end program test_results
