!> Reads the result files of rsc, by netcdf-fortran: any variable by its name, into an array of its
!> rank.
!>
!>     use rsc_results
!>     type(rsc_result) :: r
!>     real(real64), allocatable :: force(:,:), pressure(:,:,:)
!>     call r%open('output/rsc.nc')
!>     call r%get('force', force)                        ! force(step, realization)
!>     if (r%has('map_pressure')) call r%get('map_pressure', pressure)
!>     call r%close()
!>
!> A result file lists its dimensions slowest first, and Fortran sees them reversed:
!> map_pressure(step,y,x) of ncdump is map_pressure(x,y,step) here. Indices count from 1 in the
!> file, too. rsc_is_absent(value) finds what is missing. Attributes: nf90_get_att(r%id, ...). With
!> stat a failure is reported in it and in errmsg; without stat it is an error stop.
module rsc_results
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use netcdf
  implicit none
  private
  public :: rsc_result, rsc_is_absent, real64

  integer, parameter :: cut = 1  !< a status of this module; those of NetCDF are below 0

  type :: rsc_result
    integer :: id = -1                    !< of netcdf-fortran
    character(:), allocatable :: file     !< its name
  contains
    procedure :: open => open_result
    procedure :: has => has_variable
    !> Reals of rank 0 to 3; counts, indices and statuses of rank 1 or 2.
    generic :: get => get_reals, get_integers
    procedure, private :: get_reals, get_integers
    procedure :: close => close_result
  end type

contains
  elemental logical function rsc_is_absent(value)
    real(real64), intent(in) :: value
    rsc_is_absent = value >= nf90_fill_double
  end function

  subroutine open_result(self, file, stat, errmsg)
    class(rsc_result), intent(inout) :: self
    character(*), intent(in) :: file
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: status
    self%file = trim(file)
    status = nf90_open(self%file, nf90_nowrite, self%id)
    if (status == nf90_noerr .and. .not. (self%has('force') .and. self%has('map_pressure'))) then
      status = nf90_enotvar
    else if (status == nf90_noerr) then
      if (lacks_end(self)) status = cut
    end if
    if (status == nf90_enotvar .or. status == cut) call self%close()
    call finish(self, '', status, stat, errmsg)
  end subroutine

  !> True for a result of rsc 0.3 or later without its last line: of a cut file NetCDF returns
  !> zeros.
  logical function lacks_end(self)
    class(rsc_result), intent(in) :: self
    character(*), parameter :: start = new_line('a') // 'rsc: CRC-32 of all before this line: '
    character(len(start) + 9) :: line
    character(:), allocatable :: source
    integer(int64) :: bytes
    integer :: length, status, unit
    lacks_end = .false.
    status = nf90_inquire_attribute(self%id, nf90_global, 'source', len=length)
    if (status /= nf90_noerr .or. length < 8) return
    allocate (character(length) :: source)
    status = nf90_get_att(self%id, nf90_global, 'source', source)
    if (status /= nf90_noerr .or. source(:4) /= 'rsc ') return
    if (any(source(5:8) == ['0.0.', '0.1.', '0.2.'])) return
    line = ''
    open (newunit=unit, file=self%file, access='stream', form='unformatted', action='read', &
          iostat=status)
    if (status /= 0) return
    inquire (unit, size=bytes)
    read (unit, pos=max(bytes - len(line), 0_int64) + 1, iostat=status) line
    close (unit)
    lacks_end = line(:len(start)) /= start .or. line(len(line):) /= new_line('a')
  end function

  subroutine close_result(self)
    class(rsc_result), intent(inout) :: self
    integer :: ignored
    ignored = nf90_close(self%id)
    self%id = -1
  end subroutine

  logical function has_variable(self, name)
    class(rsc_result), intent(in) :: self
    character(*), intent(in) :: name
    integer :: variable
    has_variable = nf90_inq_varid(self%id, name, variable) == nf90_noerr
  end function

  subroutine get_reals(self, name, values, stat, errmsg)
    class(rsc_result), intent(in) :: self
    character(*), intent(in) :: name
    real(real64), allocatable, intent(out) :: values(..)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: variable, n(3), status
    call find(self, name, rank(values), variable, n, status)
    if (status == nf90_noerr) then
      select rank (values)
      rank (0)
        allocate (values)
        status = nf90_get_var(self%id, variable, values)
      rank (1)
        allocate (values(n(1)))
        status = nf90_get_var(self%id, variable, values)
      rank (2)
        allocate (values(n(1), n(2)))
        status = nf90_get_var(self%id, variable, values)
      rank (3)
        allocate (values(n(1), n(2), n(3)))
        status = nf90_get_var(self%id, variable, values)
      end select
    end if
    call finish(self, name, status, stat, errmsg)
  end subroutine

  subroutine get_integers(self, name, values, stat, errmsg)
    class(rsc_result), intent(in) :: self
    character(*), intent(in) :: name
    integer, allocatable, intent(out) :: values(..)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: variable, n(3), status
    call find(self, name, rank(values), variable, n, status)
    if (status == nf90_noerr) then
      select rank (values)
      rank (1)
        allocate (values(n(1)))
        status = nf90_get_var(self%id, variable, values)
      rank (2)
        allocate (values(n(1), n(2)))
        status = nf90_get_var(self%id, variable, values)
      end select
    end if
    call finish(self, name, status, stat, errmsg)
  end subroutine

  !> A variable and its extents, the last dimension of the file first.
  subroutine find(self, name, rank_wanted, variable, n, status)
    class(rsc_result), intent(in) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: rank_wanted
    integer, intent(out) :: variable, n(3), status
    integer :: k, dimensions, ids(nf90_max_var_dims)
    status = nf90_inq_varid(self%id, name, variable)
    if (status /= nf90_noerr) return
    status = nf90_inquire_variable(self%id, variable, ndims=dimensions, dimids=ids)
    if (status == nf90_noerr .and. dimensions /= rank_wanted) status = nf90_einvalcoords
    do k = 1, dimensions
      if (status == nf90_noerr) status = nf90_inquire_dimension(self%id, ids(k), len=n(k))
    end do
  end subroutine

  subroutine finish(self, name, status, stat, errmsg)
    class(rsc_result), intent(in) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: message
    if (present(stat)) stat = status
    if (status == nf90_noerr) return
    message = "cannot read '" // self%file // "': "
    if (status == cut) then
      message = message // 'is cut or damaged: its last line, the checksum, is missing'
    else
      message = message // trim(nf90_strerror(status))
    end if
    if (name /= '') message = message // " (variable '" // name // "')"
    if (name == '' .and. status == nf90_enotvar) message = message // ': no result of rsc'
    if (status == nf90_einvalcoords) message = message // ': the array has another rank'
    if (.not. present(stat)) error stop 'rsc_results: ' // message
    if (present(errmsg)) errmsg = message
  end subroutine
end module rsc_results
