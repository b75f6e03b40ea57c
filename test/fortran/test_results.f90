! rsc_results reads what rsc wrote: `test_results ONE MANY OTHER CASE...`, results of one and of three realizations made from known numbers,
! a file that is none, and results of the program.
program test_results
  use, intrinsic :: iso_fortran_env, only: real64
  use netcdf
  use rsc_results
  implicit none
  integer, parameter :: asperities = 6000, steps = 12, points = 64
  real(real64), parameter :: pi = acos(-1.0_real64), sigma = 0.01_real64
  integer :: failures = 0, i

  call test_one(argument(1))
  call test_many(argument(2))
  call every_variable(argument(1))
  call every_variable(argument(2))
  call test_refusals(argument(3))
  do i = 4, command_argument_count()
    call every_variable(argument(i))
  end do
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
    call check(r%realizations() == 3 .and. r%steps() == steps .and. all(r%realization == [1, 2, 3]), 'three realizations')
    call check(size(r%asperity_x) == 0 .and. size(r%contact_start) == 0, 'no contacts kept of single realizations')
    call check(size(r%height) == 0, 'no heights kept of single realizations')
    do s = 1, steps
      mean = sum(r%force(s, :)) / 3
      call check(near(r%force_mean(s), mean, 1e-14_real64), 'mean force')
      call check(near(r%force_std(s), sqrt(sum((r%force(s, :) - mean)**2) / 2), 1e-12_real64), 'deviation of the force')
    end do
    call check(near(r%m2(3), 0.023_real64, 1e-14_real64), 'm2')
  end subroutine test_many

  ! Every member holds the variable of its name, value by value.
  subroutine every_variable(file)
    character(*), intent(in) :: file
    type(rsc_result) :: r
    integer :: id, kind, number
    character(24) :: seed
    call rsc_read_result(file, r)
    call check(nf90_open(file, nf90_nowrite, id) == nf90_noerr, 'open')
    include 'results_variables.inc'  ! written by results_variables.py from the members of rsc_result
    call same_text(id, 'title', r%title)
    call same_text(id, 'source', r%source)
    call same_text(id, 'history', r%history)
    call same_text(id, 'references', r%references)
    call same_text(id, 'case', r%case)
    if (nf90_inquire_attribute(id, nf90_global, 'seed', xtype=kind) == nf90_noerr .and. kind == nf90_char) then
      write (seed, '(i0)') r%seed
      call same_text(id, 'seed', trim(seed))  ! beyond 32 bits
    else
      call check(nf90_get_att(id, nf90_global, 'seed', number) == nf90_noerr .and. r%seed == number, 'seed')
    end if
    call check(nf90_close(id) == nf90_noerr, 'close')
  end subroutine every_variable

  subroutine same_text(id, name, text)
    integer, intent(in) :: id
    character(*), intent(in) :: name, text
    integer :: length
    character(:), allocatable :: there
    call check(nf90_inquire_attribute(id, nf90_global, name, len=length) == nf90_noerr, name // ' is there')
    allocate (character(length) :: there)
    call check(nf90_get_att(id, nf90_global, name, there) == nf90_noerr, name)
    call check(len(text) > 0 .and. len(text) == length .and. text == there, name // ' is that of the file')
  end subroutine same_text

  ! The values of the variable, and its extents, the last dimension of the file first; missing ones are 1.
  subroutine same(id, name, values, extent)
    integer, intent(in) :: id
    character(*), intent(in) :: name
    real(real64), intent(in) :: values(:)
    integer, intent(in) :: extent(:)
    real(real64), allocatable :: there(:)
    logical :: absent
    integer :: variable, dimensions, ids(nf90_max_var_dims), lengths(nf90_max_var_dims), total, k
    if (nf90_inq_varid(id, name, variable) /= nf90_noerr) then
      absent = size(values) == 0
      if (size(extent) == 0) absent = all(rsc_is_absent(values))  ! scalars
      call check(absent, name // ' is not in the file')
      return
    end if
    call check(nf90_inquire_variable(id, variable, ndims=dimensions, dimids=ids) == nf90_noerr, name)
    total = 1
    do k = 1, dimensions
      call check(nf90_inquire_dimension(id, ids(k), len=lengths(k)) == nf90_noerr, name)
      total = total * lengths(k)
    end do
    allocate (there(total))
    call check(nf90_get_var(id, variable, there, count=lengths(:dimensions)) == nf90_noerr, name)
    call check(size(values) == total, name // ': number of values')
    do k = 1, size(extent)
      call check(extent(k) == merge(lengths(k), 1, k <= dimensions), name // ': extents')
    end do
    if (size(values) == total) call check(all(values >= there .and. values <= there), name // ': values')
  end subroutine same

  subroutine test_refusals(other)
    character(*), intent(in) :: other
    type(rsc_result) :: r
    character(300) :: message
    integer :: stat
    call rsc_read_result('no/such/file.nc', r, stat, message)
    call check(stat /= 0 .and. index(message, "no/such/file.nc': No such file") > 0, 'missing file: ' // trim(message))
    call rsc_read_result(other, r, stat, message)
    call check(stat /= 0 .and. index(message, other) > 0, 'not NetCDF: ' // trim(message))
    ! NetCDF files of something else, which have one of the two variables looked for.
    call foreign('force')
    call foreign('map_pressure')
    call rsc_read_result(argument(1), r, stat, message)
    call check(stat == 0 .and. index(message, other) > 0, 'errmsg keeps its value without failure')
  end subroutine test_refusals

  subroutine foreign(name)
    character(*), intent(in) :: name
    type(rsc_result) :: r
    character(300) :: message
    integer :: id, variable, stat
    call check(nf90_create('foreign.nc', nf90_clobber, id) == nf90_noerr, 'create')
    call check(nf90_def_var(id, name, nf90_double, variable) == nf90_noerr .and. nf90_close(id) == nf90_noerr, 'define')
    call rsc_read_result('foreign.nc', r, stat, message)
    call check(stat /= 0 .and. message == "cannot read the result file 'foreign.nc', which is no result of rsc: it lacks " // &
               "the variables 'force' and 'map_pressure'", 'another NetCDF file: ' // trim(message))
    call check(r%steps() == 0 .and. r%realizations() == 0, 'nothing read')
    open (newunit=id, file='foreign.nc')
    close (id, status='delete')
  end subroutine foreign

end program test_results
