! rsc_results reads what rsc wrote: `test_results OTHER RESULT...`, a file that is no result, and
! results of the program.
program test_results
  use rsc_results
  use netcdf
  implicit none
  integer :: failures = 0, i

  call refusals(argument(1), argument(2))
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
  end function

  include 'check.inc'

  ! Every variable of numbers, value by value and extent by extent, against netcdf-fortran reading
  ! it as one list.
  subroutine every_variable(file)
    character(*), intent(in) :: file
    type(rsc_result) :: r
    integer :: variable, variables, dimensions, k, kind
    integer :: ids(nf90_max_var_dims), lengths(nf90_max_var_dims)
    character(nf90_max_name) :: name
    real(real64), allocatable :: scalar, a(:), b(:,:), c(:,:,:), there(:)
    integer, allocatable :: n(:), m(:,:)
    call r%open(file)
    call check(nf90_inquire(r%id, nvariables=variables) == nf90_noerr .and. variables > 60, &
               'variables of ' // file)
    do variable = 1, variables
      call check(nf90_inquire_variable(r%id, variable, name, kind, dimensions, ids) == nf90_noerr, &
                 'inquire')
      if (kind == nf90_char) cycle
      lengths = 1
      do k = 1, dimensions
        call check(nf90_inquire_dimension(r%id, ids(k), len=lengths(k)) == nf90_noerr, name)
      end do
      if (allocated(there)) deallocate (there)
      allocate (there(product(lengths(:dimensions))))
      call check(nf90_get_var(r%id, variable, there, count=lengths(:max(dimensions, 1))) == &
                 nf90_noerr, name)
      select case (dimensions)
      case (0)
        call r%get(trim(name), scalar)
        call same(name, [scalar], there, all([1] == lengths(:1)))
      case (1)
        call r%get(trim(name), a)
        call same(name, a, there, all(shape(a) == lengths(:1)))
        if (kind == nf90_int) call r%get(trim(name), n)
        if (kind == nf90_int) call same(name, real(n, real64), there, .true.)
      case (2)
        call r%get(trim(name), b)
        call same(name, [b], there, all(shape(b) == lengths(:2)))
        if (kind == nf90_int) call r%get(trim(name), m)
        if (kind == nf90_int) call same(name, real([m], real64), there, .true.)
      case (3)
        call r%get(trim(name), c)
        call same(name, [c], there, all(shape(c) == lengths(:3)))
      end select
    end do
    call r%close()
  end subroutine

  subroutine same(name, values, there, extents)
    character(*), intent(in) :: name
    real(real64), intent(in) :: values(:), there(:)
    logical, intent(in) :: extents
    call check(extents, trim(name) // ': extents')
    if (size(values) == size(there)) &
      call check(all(values >= there .and. values <= there), trim(name) // ': values')
  end subroutine

  subroutine refusals(other, result)
    character(*), intent(in) :: other, result
    type(rsc_result) :: r
    real(real64), allocatable :: values(:), deviation(:)
    character(300) :: message
    integer :: id, variable, stat
    call r%open('no/such/file.nc', stat, message)
    call check(stat /= 0 .and. index(message, 'no/such/file.nc') > 0, &
               'missing file: ' // trim(message))
    call r%open(other, stat, message)
    call check(stat /= 0 .and. index(message, other) > 0, 'not NetCDF: ' // trim(message))
    call check(nf90_create('foreign.nc', nf90_clobber, id) == nf90_noerr, 'create')
    call check(nf90_def_var(id, 'force', nf90_double, variable) == nf90_noerr .and. &
               nf90_close(id) == nf90_noerr, 'define')
    call r%open('foreign.nc', stat, message)
    call check(stat /= 0 .and. index(message, 'foreign.nc') > 0, &
               'another NetCDF file: ' // trim(message))
    open (newunit=id, file='foreign.nc')
    close (id, status='delete')
    call copy(result, 'cut.nc', 47)  ! without the last line
    call r%open('cut.nc', stat, message)
    call check(stat /= 0 .and. index(message, 'cut or damaged') > 0, 'cut: ' // trim(message))
    open (newunit=id, file='cut.nc')
    close (id, status='delete')
    message = 'untouched'
    call r%open(result, stat, message)
    call check(stat == 0 .and. message == 'untouched', 'errmsg keeps its value without failure')
    call r%get('nothing', values, stat, message)
    call check(stat /= 0 .and. index(message, 'nothing') > 0, 'no such variable: ' // trim(message))
    call r%get('force', values, stat, message)
    call check(stat /= 0 .and. index(message, 'rank') > 0, 'another rank: ' // trim(message))
    call check(r%has('force') .and. .not. r%has('nothing'), 'has')
    call r%get('force_std', deviation)
    call check(all(rsc_is_absent(deviation)) .and. .not. rsc_is_absent(0d0), &
               'no deviation over one realization')
    call r%close()
    call r%get('force', values, stat, message)
    call check(stat /= 0, 'a closed file')
  end subroutine

  !> Copies a file without its last bytes.
  subroutine copy(from, to, lost)
    character(*), intent(in) :: from, to
    integer, intent(in) :: lost
    character(:), allocatable :: content
    integer :: unit, bytes
    open (newunit=unit, file=from, access='stream', form='unformatted', action='read')
    inquire (unit, size=bytes)
    allocate (character(bytes - lost) :: content)
    read (unit) content
    close (unit)
    open (newunit=unit, file=to, access='stream', form='unformatted', status='replace')
    write (unit) content
    close (unit)
  end subroutine
end program test_results
