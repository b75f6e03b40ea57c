! rsc_results reads what rsc wrote: `test_results OTHER RESULT...`, a file that is no result, and results of the program.
program test_results
  use, intrinsic :: iso_fortran_env, only: real64
  use netcdf
  use rsc_results
  implicit none
  integer :: failures = 0, i

  call test_refusals(argument(1), argument(2))
  do i = 2, command_argument_count()
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

  include 'check.inc'

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

  subroutine test_refusals(other, result)
    character(*), intent(in) :: other, result
    type(rsc_result) :: r
    character(300) :: message
    integer :: stat
    call rsc_read_result('no/such/file.nc', r, stat, message)
    call check(stat /= 0 .and. index(message, 'no/such/file.nc') > 0, 'missing file: ' // trim(message))
    call rsc_read_result(other, r, stat, message)
    call check(stat /= 0 .and. index(message, other) > 0, 'not NetCDF: ' // trim(message))
    ! NetCDF files of something else, which have one of the two variables looked for.
    call foreign('force')
    call foreign('map_pressure')
    call rsc_read_result(result, r, stat, message)
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
    call check(stat /= 0 .and. index(message, 'foreign.nc') > 0, 'another NetCDF file: ' // trim(message))
    call check(r%steps() == 0 .and. r%realizations() == 0, 'nothing read')
    open (newunit=id, file='foreign.nc')
    close (id, status='delete')
  end subroutine foreign

end program test_results
