!> Reads the result files of rsc into Fortran arrays, with netcdf-fortran.
!>
!> A result file lists its dimensions slowest first, as ncdump prints them; Fortran sees them reversed: map_pressure(step,y,x) of the
!> file is map_pressure(x,y,step) here. Indices count from 1 in the file already, so they are used as they are:
!>
!>     use rsc_results
!>     type(rsc_result) :: r
!>     call rsc_read_result('output/rsc.nc', r)
!>     print *, r%separation(:,1), r%force(:,1)
!>     associate (first => r%contact_start(s), last => r%contact_start(s) + r%contact_count(s) - 1)
!>       print *, r%asperity_x(r%contact_asperity(first:last)), r%contact_force(first:last)
!>     end associate
!>
!> Every other variable of the file is available by name, as a list of numbers with the first index of the Fortran array running fastest:
!>
!>     call r%names(list)                                 ! character(:), allocatable :: list(:)
!>     call r%get('friction_force', values, shape)        ! real(real64), allocatable :: values(:); integer, allocatable :: shape(:)
!>     field = reshape(values, [shape(1), shape(2), shape(3)])
!>
!> Data that a file does not contain (contacts of a campaign, heights not requested) are arrays of size zero here. A missing value
!> (the deviation over a single realization) is rsc_absent; test it by rsc_is_absent(value).
module rsc_results
  use, intrinsic :: iso_fortran_env, only: real64, int32, int64, error_unit
  use netcdf
  implicit none
  private
  public :: rsc_result, rsc_read_result, rsc_absent, rsc_is_absent

  !> The fill value of the file.
  real(real64), parameter :: rsc_absent = nf90_fill_double

  !> One result file; names, units and meanings are those of its variables. R realizations, S levels.
  type :: rsc_result
    character(:), allocatable :: file  !< its name
    character(:), allocatable :: title, source, history, references, case
    integer(int64) :: seed = 0

    ! The levels: (step), and (step, realization).
    integer(int32), allocatable :: realization(:)
    real(real64), allocatable :: separation(:,:), separation_sigma(:,:)  !< (S,1), or (S,R) under force control
    real(real64), allocatable :: force(:,:), contact_area(:,:), residual(:,:)
    real(real64), allocatable :: stiffness(:,:), energy(:,:)             !< size zero if it was not computed
    real(real64), allocatable :: conductance_length(:,:), resistance(:,:)  !< resistance: with resistivities only
    real(real64), allocatable :: lateral_force(:,:,:)                    !< (2, S, R): along x and y
    integer(int32), allocatable :: contacts(:,:), candidates(:,:), iterations(:,:), status(:,:), method(:,:)
    integer(int32), allocatable :: products(:,:), overlapping_pairs(:,:), large_contacts(:,:), crowded_cells(:,:)
    integer(int32), allocatable :: beyond_law(:,:)                       !< contacts past the range of the asperity law
    real(real64), allocatable :: force_mean(:), force_std(:), contact_area_mean(:), contact_area_std(:)
    real(real64), allocatable :: area_I(:), area_II(:), area_hertz(:)

    ! The surfaces: (realization); closed forms: scalars.
    real(real64), allocatable :: sigma(:), m2(:), m4(:), rms_slope(:), mean_kappa_g(:)
    integer(int32), allocatable :: summits(:), saddles(:)
    real(real64) :: m0_theory = rsc_absent, m2_theory = rsc_absent, m4_theory = rsc_absent
    real(real64) :: nayak_theory = rsc_absent, density_theory = rsc_absent
    real(real64) :: e_star = rsc_absent, r_star = rsc_absent, transition_force = rsc_absent
    real(real64) :: tip_x = rsc_absent, tip_y = rsc_absent

    ! Maps (x, y, step) and radial means (radius, step).
    real(real64), allocatable :: x(:), y(:), map_area_fraction(:,:,:), map_pressure(:,:,:)
    real(real64), allocatable :: radius(:), radial_area_fraction(:,:), radial_pressure(:,:), hertz_pressure(:,:)

    ! Distributions (bin, pdf_level), and the middles of their bins.
    real(real64), allocatable :: pdf_level(:), pdf_separation_sigma(:)
    real(real64), allocatable :: pressure_mean_bin(:), pressure_bin(:), spot_area_bin(:)
    real(real64), allocatable :: pressure_mean_pdf(:,:), pressure_pdf(:,:), spot_area_pdf(:,:)

    ! Asperities, contacts and heights of one realization.
    real(real64), allocatable :: asperity_x(:), asperity_y(:), asperity_z(:), asperity_radius(:)
    real(real64), allocatable :: asperity_kappa1(:), asperity_kappa2(:), asperity_angle(:), asperity_biharmonic(:)
    integer(int32), allocatable :: contact_start(:), contact_count(:), contact_asperity(:)
    real(real64), allocatable :: contact_force(:), contact_radius(:)
    real(real64), allocatable :: height(:,:), height_x(:), height_y(:)   !< height(x, y)
  contains
    procedure :: realizations => number_of_realizations
    procedure :: steps => number_of_steps
    procedure :: names => names_of_variables
    procedure :: get => get_by_name
  end type rsc_result

  !> Reads one whole variable of any shape; size zero if the file does not have it.
  interface get
    module procedure get_real0, get_real1, get_real2, get_real3, get_int1, get_int2
  end interface get

  !> The file being read, and the first failure, after which all calls do nothing.
  type :: reader
    integer :: id = -1
    integer :: status = nf90_noerr
    character(:), allocatable :: what
  end type reader

contains

  !> Reads the result file `file` into `result`. With `stat` a failure is reported in it (0: success; otherwise `result` is
!> invalid) and, as text, in `errmsg`, which otherwise keeps its value; without `stat` a failure stops the program with its message.
  subroutine rsc_read_result(file, result, stat, errmsg)
    character(*), intent(in) :: file
    type(rsc_result), intent(out) :: result
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(reader) :: r

    r%what = ''
    call check_sound(r, trim(file))
    if (r%status == nf90_noerr) r%status = nf90_open(file, nf90_nowrite, r%id)
    if (r%status == nf90_noerr) then
      call check_kind(r)
      call get_attributes(r, result)
      call get_variables(r, result)
      call close_file(r)
    end if

    result%file = trim(file)
    call tell(r, file, stat, errmsg)
  end subroutine rsc_read_result

  !> The message of the first failure, if any.
  subroutine tell(r, file, stat, errmsg)
    type(reader), intent(in) :: r
    character(*), intent(in) :: file
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: message
    if (present(stat)) stat = r%status
    if (r%status == nf90_noerr) return
    message = "cannot read the result file '" // trim(file) // "'"
    if (len(r%what) > 0) message = message // ', ' // r%what
    if (len(r%what) == 0 .or. index(r%what, 'variable') == 1) message = message // ': ' // trim(nf90_strerror(r%status))
    if (present(errmsg)) errmsg = message
    if (.not. present(stat)) then
      write (error_unit, '(a)') message
      error stop 1
    end if
  end subroutine tell

  !> The names of all variables of the file, padded with blanks.
  subroutine names_of_variables(self, list, stat, errmsg)
    class(rsc_result), intent(in) :: self
    character(:), allocatable, intent(out) :: list(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(reader) :: r
    character(nf90_max_name) :: name
    integer :: n, k
    call open_again(r, self)
    n = 0
    if (r%status == nf90_noerr) r%status = nf90_inquire(r%id, nvariables=n)
    allocate (character(nf90_max_name) :: list(n))
    do k = 1, n
      if (r%status == nf90_noerr) r%status = nf90_inquire_variable(r%id, k, name=name)
      list(k) = name
    end do
    if (r%id >= 0) call close_file(r)
    call tell(r, self%file, stat, errmsg)
  end subroutine names_of_variables

  !> The numbers of any variable, in the order of a Fortran array of that shape; a scalar has the shape [1]. For texts, the bytes.
  subroutine get_by_name(self, name, values, shape, stat, errmsg)
    class(rsc_result), intent(in) :: self
    character(*), intent(in) :: name
    real(real64), allocatable, intent(out) :: values(:)
    integer, allocatable, intent(out), optional :: shape(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(reader) :: r
    character, allocatable :: text(:)
    integer :: varid, kind, lengths(nf90_max_var_dims), ndims
    call open_again(r, self)
    call inquire_variable(r, name, varid, lengths, kind, ndims)
    if (r%status == nf90_noerr .and. varid < 0) r%status = nf90_enotvar
    if (r%status /= nf90_noerr) lengths = 0
    ndims = max(ndims, 1)
    allocate (values(product(lengths(:ndims))), text(0))
    if (r%status == nf90_noerr) then
      if (kind == nf90_char) then
        deallocate (text)
        allocate (text(size(values)))
        r%status = nf90_get_var(r%id, varid, text, count=lengths(:ndims))
        values = real(ichar(text), real64)
      else
        r%status = nf90_get_var(r%id, varid, values, count=lengths(:ndims))
      end if
    end if
    call note(r, name)
    if (r%id >= 0) call close_file(r)
    if (present(shape)) shape = lengths(:ndims)
    call tell(r, self%file, stat, errmsg)
  end subroutine get_by_name

  subroutine open_again(r, result)
    type(reader), intent(out) :: r
    class(rsc_result), intent(in) :: result
    r%what = ''
    r%status = nf90_enotnc
    if (allocated(result%file)) r%status = nf90_open(result%file, nf90_nowrite, r%id)
  end subroutine open_again

  !> True for the fill value, which is far from any result.
  elemental logical function rsc_is_absent(value)
    real(real64), intent(in) :: value
    rsc_is_absent = value > 0.99_real64 * rsc_absent
  end function rsc_is_absent

  pure integer function number_of_realizations(self) result(n)
    class(rsc_result), intent(in) :: self
    n = 0
    if (allocated(self%force)) n = size(self%force, 2)
  end function number_of_realizations

  pure integer function number_of_steps(self) result(n)
    class(rsc_result), intent(in) :: self
    n = 0
    if (allocated(self%force)) n = size(self%force, 1)
  end function number_of_steps

  !> Checks the checksum (CRC-32) in the last line of a result before HDF5 opens the file, because HDF5 crashes on some
!> damaged files.
  subroutine check_sound(r, file)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: file
    character(*), parameter :: start = new_line('a') // 'rsc: CRC-32 of all before this line: '
    integer, parameter :: chunk = 65536
    character(len(start) + 9) :: line
    character(chunk) :: bytes
    integer(int64) :: left
    integer(int32) :: table(0:255), crc
    character(8) :: digits
    integer :: unit, k, j, n, problem
    open (newunit=unit, file=file, access='stream', form='unformatted', action='read', status='old', iostat=problem)
    if (problem /= 0) return  ! reported when NetCDF opens it
    inquire (unit=unit, size=left)
    left = left - len(line)
    if (left > 0) read (unit, pos=left + 1, iostat=problem) line
    if (left <= 0 .or. problem /= 0 .or. line(:len(start)) /= start) then
      close (unit)
      return
    end if
    do k = 0, 255
      crc = k
      do j = 1, 8
        crc = merge(ieor(ishft(crc, -1), int(z'EDB88320', int32)), ishft(crc, -1), btest(crc, 0))
      end do
      table(k) = crc
    end do
    crc = not(0_int32)
    read (unit, pos=1, iostat=problem)
    do while (left > 0 .and. problem == 0)
      n = int(min(left, int(chunk, int64)))
      read (unit, iostat=problem) bytes(:n)
      do k = 1, n
        crc = ieor(ishft(crc, -8), table(iand(ieor(crc, ichar(bytes(k:k))), 255)))
      end do
      left = left - n
    end do
    close (unit)
    write (digits, '(z8.8)') not(crc)
    do k = 1, 8
      if (digits(k:k) >= 'A') digits(k:k) = achar(iachar(digits(k:k)) + 32)
    end do
    if (problem == 0 .and. digits == line(len(start) + 1:len(start) + 8)) return
    r%status = nf90_enotnc
    r%what = 'which is damaged, or was changed since rsc wrote it: its checksum does not hold'
  end subroutine check_sound

  !> Refuses other NetCDF files, which would be read as empty results.
  subroutine check_kind(r)
    type(reader), intent(inout) :: r
    integer :: varid
    if (nf90_inq_varid(r%id, 'force', varid) /= nf90_noerr .or. nf90_inq_varid(r%id, 'map_pressure', varid) /= nf90_noerr) then
      r%status = nf90_enotvar
      r%what = "which is no result of rsc: it lacks the variables 'force' and 'map_pressure'"
    end if
  end subroutine check_kind

  subroutine close_file(r)
    type(reader), intent(inout) :: r
    integer :: status
    status = nf90_close(r%id)
    if (r%status == nf90_noerr) r%status = status
  end subroutine close_file

  subroutine get_attributes(r, a)
    type(reader), intent(inout) :: r
    type(rsc_result), intent(inout) :: a
    character(:), allocatable :: text
    integer(int32) :: seed
    integer :: kind, length
    call get_text(r, 'title', a%title)
    call get_text(r, 'source', a%source)
    call get_text(r, 'history', a%history)
    call get_text(r, 'references', a%references)
    call get_text(r, 'case', a%case)
    if (r%status /= nf90_noerr) return
    if (nf90_inquire_attribute(r%id, nf90_global, 'seed', xtype=kind, len=length) /= nf90_noerr) return
    if (kind == nf90_char) then  ! a seed beyond 32 bits
      call get_text(r, 'seed', text)
      read (text, *, iostat=length) a%seed
    else if (nf90_get_att(r%id, nf90_global, 'seed', seed) == nf90_noerr) then
      a%seed = seed
    end if
  end subroutine get_attributes

  subroutine get_variables(r, a)
    type(reader), intent(inout) :: r
    type(rsc_result), intent(inout) :: a
    call get(r, 'realization', a%realization)
    call get(r, 'separation', a%separation)
    call get(r, 'separation_sigma', a%separation_sigma)
    call get(r, 'force', a%force)
    call get(r, 'contact_area', a%contact_area)
    call get(r, 'residual', a%residual)
    call get(r, 'stiffness', a%stiffness)
    call get(r, 'energy', a%energy)
    call get(r, 'conductance_length', a%conductance_length)
    call get(r, 'resistance', a%resistance)
    call get(r, 'lateral_force', a%lateral_force)
    call get(r, 'contacts', a%contacts)
    call get(r, 'candidates', a%candidates)
    call get(r, 'iterations', a%iterations)
    call get(r, 'status', a%status)
    call get(r, 'method', a%method)
    call get(r, 'products', a%products)
    call get(r, 'overlapping_pairs', a%overlapping_pairs)
    call get(r, 'large_contacts', a%large_contacts)
    call get(r, 'beyond_law', a%beyond_law)
    call get(r, 'crowded_cells', a%crowded_cells)
    call get(r, 'force_mean', a%force_mean)
    call get(r, 'force_std', a%force_std)
    call get(r, 'contact_area_mean', a%contact_area_mean)
    call get(r, 'contact_area_std', a%contact_area_std)
    call get(r, 'area_I', a%area_I)
    call get(r, 'area_II', a%area_II)
    call get(r, 'area_hertz', a%area_hertz)
    call get(r, 'sigma', a%sigma)
    call get(r, 'm2', a%m2)
    call get(r, 'm4', a%m4)
    call get(r, 'rms_slope', a%rms_slope)
    call get(r, 'mean_kappa_g', a%mean_kappa_g)
    call get(r, 'summits', a%summits)
    call get(r, 'saddles', a%saddles)
    call get(r, 'm0_theory', a%m0_theory)
    call get(r, 'm2_theory', a%m2_theory)
    call get(r, 'm4_theory', a%m4_theory)
    call get(r, 'nayak_theory', a%nayak_theory)
    call get(r, 'density_theory', a%density_theory)
    call get(r, 'e_star', a%e_star)
    call get(r, 'r_star', a%r_star)
    call get(r, 'transition_force', a%transition_force)
    call get(r, 'tip_x', a%tip_x)
    call get(r, 'tip_y', a%tip_y)
    call get(r, 'x', a%x)
    call get(r, 'y', a%y)
    call get(r, 'map_area_fraction', a%map_area_fraction)
    call get(r, 'map_pressure', a%map_pressure)
    call get(r, 'radius', a%radius)
    call get(r, 'radial_area_fraction', a%radial_area_fraction)
    call get(r, 'radial_pressure', a%radial_pressure)
    call get(r, 'hertz_pressure', a%hertz_pressure)
    call get(r, 'pdf_level', a%pdf_level)
    call get(r, 'pdf_separation_sigma', a%pdf_separation_sigma)
    call get(r, 'pressure_mean_bin', a%pressure_mean_bin)
    call get(r, 'pressure_bin', a%pressure_bin)
    call get(r, 'spot_area_bin', a%spot_area_bin)
    call get(r, 'pressure_mean_pdf', a%pressure_mean_pdf)
    call get(r, 'pressure_pdf', a%pressure_pdf)
    call get(r, 'spot_area_pdf', a%spot_area_pdf)
    call get(r, 'asperity_x', a%asperity_x)
    call get(r, 'asperity_y', a%asperity_y)
    call get(r, 'asperity_z', a%asperity_z)
    call get(r, 'asperity_radius', a%asperity_radius)
    call get(r, 'asperity_kappa1', a%asperity_kappa1)
    call get(r, 'asperity_kappa2', a%asperity_kappa2)
    call get(r, 'asperity_angle', a%asperity_angle)
    call get(r, 'asperity_biharmonic', a%asperity_biharmonic)
    call get(r, 'contact_start', a%contact_start)
    call get(r, 'contact_count', a%contact_count)
    call get(r, 'contact_asperity', a%contact_asperity)
    call get(r, 'contact_force', a%contact_force)
    call get(r, 'contact_radius', a%contact_radius)
    call get(r, 'height', a%height)
    call get(r, 'height_x', a%height_x)
    call get(r, 'height_y', a%height_y)
  end subroutine get_variables

  !> The shape of a variable in Fortran's order, padded with ones; zeros and varid = -1 if the file does not have it.
  subroutine inquire_variable(r, name, varid, shape, kind, rank)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    integer, intent(out) :: varid, shape(:)
    integer, intent(out), optional :: kind, rank
    integer :: dims(nf90_max_var_dims), ndims, d
    shape = 0
    varid = -1
    if (present(rank)) rank = 0
    if (r%status /= nf90_noerr) return
    if (nf90_inq_varid(r%id, name, varid) /= nf90_noerr) then
      varid = -1
      return
    end if
    r%status = nf90_inquire_variable(r%id, varid, xtype=kind, ndims=ndims, dimids=dims)
    if (r%status == nf90_noerr .and. ndims > size(shape)) r%status = nf90_einvalcoords
    if (r%status == nf90_noerr) then
      shape = 1
      do d = 1, ndims
        r%status = nf90_inquire_dimension(r%id, dims(d), len=shape(d))
        if (r%status /= nf90_noerr) exit
      end do
      if (present(rank)) rank = ndims
    end if
    call note(r, name)
  end subroutine inquire_variable

  !> Records the variable of the first failure.
  subroutine note(r, name)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    if (r%status /= nf90_noerr .and. len(r%what) == 0) r%what = "variable '" // name // "'"
  end subroutine note

  subroutine get_text(r, name, text)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    character(:), allocatable, intent(out) :: text
    integer :: length
    if (r%status /= nf90_noerr) return
    if (nf90_inquire_attribute(r%id, nf90_global, name, len=length) /= nf90_noerr) length = 0
    allocate (character(length) :: text)
    if (length > 0) r%status = nf90_get_att(r%id, nf90_global, name, text)
    call note(r, name)
  end subroutine get_text

  subroutine get_real0(r, name, values)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    real(real64), intent(inout) :: values
    integer :: varid, shape(1)
    call inquire_variable(r, name, varid, shape)
    if (r%status == nf90_noerr .and. varid > 0) r%status = nf90_get_var(r%id, varid, values)
    call note(r, name)
  end subroutine get_real0

  subroutine get_real1(r, name, values)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    real(real64), allocatable, intent(out) :: values(:)
    integer :: varid, shape(1)
    call inquire_variable(r, name, varid, shape)
    allocate (values(shape(1)))
    if (r%status == nf90_noerr .and. varid > 0) r%status = nf90_get_var(r%id, varid, values)
    call note(r, name)
  end subroutine get_real1

  subroutine get_real2(r, name, values)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    real(real64), allocatable, intent(out) :: values(:,:)
    integer :: varid, shape(2)
    call inquire_variable(r, name, varid, shape)
    allocate (values(shape(1), shape(2)))
    if (r%status == nf90_noerr .and. varid > 0) r%status = nf90_get_var(r%id, varid, values, count=shape)
    call note(r, name)
  end subroutine get_real2

  subroutine get_real3(r, name, values)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    real(real64), allocatable, intent(out) :: values(:,:,:)
    integer :: varid, shape(3)
    call inquire_variable(r, name, varid, shape)
    allocate (values(shape(1), shape(2), shape(3)))
    if (r%status == nf90_noerr .and. varid > 0) r%status = nf90_get_var(r%id, varid, values)
    call note(r, name)
  end subroutine get_real3

  subroutine get_int1(r, name, values)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    integer(int32), allocatable, intent(out) :: values(:)
    integer :: varid, shape(1)
    call inquire_variable(r, name, varid, shape)
    allocate (values(shape(1)))
    if (r%status == nf90_noerr .and. varid > 0) r%status = nf90_get_var(r%id, varid, values)
    call note(r, name)
  end subroutine get_int1

  subroutine get_int2(r, name, values)
    type(reader), intent(inout) :: r
    character(*), intent(in) :: name
    integer(int32), allocatable, intent(out) :: values(:,:)
    integer :: varid, shape(2)
    call inquire_variable(r, name, varid, shape)
    allocate (values(shape(1), shape(2)))
    if (r%status == nf90_noerr .and. varid > 0) r%status = nf90_get_var(r%id, varid, values)
    call note(r, name)
  end subroutine get_int2

end module rsc_results
