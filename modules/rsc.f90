!> rsc in Fortran: the contact of a sphere with a rough surface of asperities. It provides the
!> functions of rsc.h; see there for details of every argument.
!>
!>     use rsc
!>     type(rsc_asperities) :: asperities
!>     type(rsc_contact) :: contact
!>     call asperities%take(x, y, z, radius)
!>     call contact%create(asperities, E_star=94.7d3, R=2.5d0, x0=0.5d0, y0=0.5d0)
!>     call contact%indent(separation=0.02d0, force=N)
!>     print *, N, contact%area(), contact%stiffness()
!>
!> An object refers to something of the library, as a pointer does: assignment (b = a, whole arrays,
!> types that contain objects, source=, firstprivate) makes another name for the same contact. `call
!> b%copy(a)` gives b a contact of its own, with result and path; `call q%copy(q)` does so after q =
!> p. `call a%free()` releases it, and every other name of it is an error status (or an error stop)
!> from then on, never released memory. Creating an object again releases its former content.
!> Nothing is released by itself, also not where a variable goes out of scope or a list is
!> deallocated. Different objects may be used by different threads at the same time; names of one
!> object may not.
!>
!> Every procedure has stat and errmsg like the statements of the language: with stat, a failure is
!> reported in it (negative: wrong argument; positive: one of the rsc_* codes) and in errmsg, which
!> otherwise keeps its value; without stat, a failure is an error stop with the message. After a
!> failure functions return 0, allocatable arrays have size 0, and other outputs are undefined,
!> except with stat = rsc_not_converged. Asperities count from 1.
module rsc
  use, intrinsic :: iso_c_binding, only: c_ptr, c_funptr, c_funloc, c_null_ptr, c_associated, &
      c_char, c_null_char, c_double, c_float, c_int32_t, c_int64_t
  implicit none
  private
  public :: rsc_case, rsc_surface, rsc_asperities, rsc_contact, rsc_friction, rsc_library_version
  public :: rsc_stiffness_ratio, rsc_press_all, rsc_indent_all, rsc_step_all, rsc_watch, rsc_lock, &
      rsc_unlock, rsc_keys

  include 'generated/interface.inc'

  ! Of src/api/handle_numbers.h: the objects store numbers, which stay safe when the compiler copies
  ! them.
  interface
    integer(c_int64_t) function rsc_number_of(handle) bind(c)
      import :: c_int64_t, c_ptr
      type(c_ptr), value :: handle
    end function
    type(c_ptr) function rsc_handle_of(number) bind(c)
      import :: c_int64_t, c_ptr
      integer(c_int64_t), value :: number
    end function
    type(c_ptr) function rsc_handle_taken(number) bind(c)
      import :: c_int64_t, c_ptr
      integer(c_int64_t), value :: number
    end function
  end interface

  !> Options by the names of the namelist, 'group%key'; all initially at their defaults.
  type :: rsc_case
    private
    integer(c_int64_t) :: number = 0
  contains
    !> set(name, value): value is a real or an integer of either usual kind, an array of them, a
    !> logical, or text in namelist syntax (with quotes if it is a text). A default real is
    !> converted to the shortest decimal number with that value: 0.1 is 0.1.
    generic :: set => set_text, set_real, set_single, set_integer, set_long, set_logical, &
        set_reals, set_singles, set_integers
    procedure :: get => case_get
    procedure :: read => case_read
    procedure :: read_file => case_read_file
    procedure :: text => case_text
    procedure :: run => case_run
    procedure :: run_watched => case_run_watched
    procedure, private :: set_text => case_set_text
    procedure, private :: set_real => case_set_real
    procedure, private :: set_single => case_set_single
    procedure, private :: set_integer => case_set_integer
    procedure, private :: set_long => case_set_long
    procedure, private :: set_reals => case_set_reals
    procedure, private :: set_singles => case_set_singles
    procedure, private :: set_integers => case_set_integers
    procedure, private :: set_logical => case_set_logical
    procedure :: copy => case_copy
    procedure :: free => case_free
  end type

  !> Heights z(i,j) at x0 + (i-1) dx, y0 + (j-1) dy.
  type :: rsc_surface
    private
    integer(c_int64_t) :: number = 0
  contains
    procedure :: synthesize => surface_synthesize
    procedure :: take => surface_take
    procedure :: detrend => surface_detrend
    procedure :: filter => surface_filter
    procedure :: grid => surface_grid
    procedure :: heights => surface_heights
    procedure :: moments => surface_moments
    procedure :: copy => surface_copy
    procedure :: free => surface_free
  end type

  !> Summits: positions and radii.
  type :: rsc_asperities
    private
    integer(c_int64_t) :: number = 0
  contains
    procedure :: find => asperities_find
    procedure :: make => asperities_make
    procedure :: take => asperities_take
    procedure :: of_contact => contact_asperities
    procedure :: count => asperities_count
    procedure :: get => asperities_get
    procedure :: curvatures => asperities_curvatures
    procedure :: copy => asperities_copy
    procedure :: free => asperities_free
  end type

  !> A sphere on asperities, and the last level computed.
  type :: rsc_contact
    private
    integer(c_int64_t) :: number = 0
  contains
    procedure :: create => contact_create
    procedure :: create_from_case => contact_create_from_case
    procedure :: move_tip => contact_move_tip
    procedure :: commit => contact_commit
    procedure :: rollback => contact_rollback
    procedure :: tip => contact_tip
    procedure :: first_touch => contact_first_touch
    procedure :: set_time => contact_set_time
    procedure :: set_distance => contact_set_distance
    procedure :: indent => contact_indent
    procedure :: press => contact_press
    procedure :: separation => contact_separation
    procedure :: force => contact_force
    procedure :: area => contact_area
    procedure :: contacts => contact_contacts
    procedure :: stiffness => contact_stiffness
    procedure :: energy => contact_energy
    procedure :: level => contact_level
    procedure :: answer => contact_answer
    procedure :: value => contact_value
    procedure :: error => contact_error
    procedure :: spots => contact_spots
    procedure :: per_asperity => contact_per_asperity
    procedure :: deflection => contact_deflection
    procedure :: save => contact_save
    procedure :: restore => contact_restore
    procedure :: copy => contact_copy
    procedure :: free => contact_free
  end type

  !> A contact with friction along any path of separations and slides.
  type :: rsc_friction
    private
    integer(c_int64_t) :: number = 0
  contains
    procedure :: create => friction_create
    procedure :: create_from_case => friction_create_from_case
    procedure :: update => friction_update
    procedure :: move_tip => friction_move_tip
    procedure :: stiffness => friction_stiffness
    procedure :: state => friction_state
    procedure :: commit => friction_commit
    procedure :: rollback => friction_rollback
    procedure :: first_loading => friction_first_loading
    procedure :: slide => friction_slide
    procedure :: full_slip => friction_full_slip
    procedure :: spots => friction_spots
    procedure :: save => friction_save
    procedure :: restore => friction_restore
    procedure :: copy => friction_copy
    procedure :: free => friction_free
  end type

  abstract interface
    !> Called by run_watched; returns 0 to continue, otherwise the run stops. done, total: levels or
    !> realizations; data: of run_watched.
    function rsc_watch(done, total, data) bind(c) result(stop)
      import :: c_double, c_int32_t, c_ptr
      real(c_double), value :: done, total
      type(c_ptr), value :: data
      integer(c_int32_t) :: stop
    end function
  end interface

  !> Of the first argument of another shape than it must have: its number in rsc.h; 0: none.
  type :: difference
    integer :: argument = 0
    character(120) :: message = ''
  end type

contains

  ! --- failures and text --------------------------------------------------------------------------

  !> Reports a failure to the caller, or stops.
  subroutine finish(status, stat, errmsg)
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: message
    if (present(stat)) stat = int(status)
    if (status == rsc_success) return
    message = last_message()
    if (status == rsc_no_memory) message = 'out of memory'
    if (index(message, 'must not be null') > 0) then
      message = message // ': the object was not created'
    end if
    if (present(stat)) then
      if (present(errmsg)) errmsg = message
    else
      error stop 'rsc: ' // message
    end if
  end subroutine

  !> Notes that an argument has another shape than it must have, if it is the first one. argument:
  !> its number in rsc.h.
  subroutine compare(argument, name, found, wanted, unlike)
    integer, intent(in) :: argument, found(:), wanted(:)
    character(*), intent(in) :: name
    type(difference), intent(inout) :: unlike
    if (unlike%argument /= 0 .or. all(found == wanted)) return
    unlike%argument = argument
    unlike%message = 'argument ' // name // ' (number ' // extents([argument]) // &
        ' in rsc.h) has the shape (' // extents(found) // '), not (' // extents(wanted) // ')'
  end subroutine

  function extents(shape) result(text)
    integer, intent(in) :: shape(:)
    character(:), allocatable :: text
    integer :: i
    text = trim(of_integer(int(shape(1), c_int64_t)))
    do i = 2, size(shape)
      text = text // ',' // trim(of_integer(int(shape(i), c_int64_t)))
    end do
  end function

  !> Reports an argument of another shape, before a function of rsc.h is called; false if all are
  !> right.
  logical function refused(caller, unlike, stat, errmsg)
    character(*), intent(in) :: caller
    type(difference), intent(in) :: unlike
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = unlike%argument /= 0
    if (.not. refused) return
    if (present(stat)) then
      stat = -unlike%argument
      if (present(errmsg)) errmsg = caller // ': ' // unlike%message
    else
      error stop 'rsc: ' // caller // ': ' // trim(unlike%message)
    end if
  end function

  !> Allocates n values, or none after a failure, so that the array has a size.
  subroutine make_room(array, n, status)
    real(c_double), allocatable, intent(out) :: array(:)
    integer(c_int64_t), intent(in) :: n
    integer(c_int32_t), intent(inout) :: status
    integer :: problem
    if (status == rsc_success) then
      allocate (array(n), stat=problem)
      if (problem /= 0) status = rsc_no_memory
    end if
    if (.not. allocated(array)) allocate (array(0))
  end subroutine

  !> Stores the handle of a constructor, if it succeeded.
  subroutine keep(number, handle, status)
    integer(c_int64_t), intent(inout) :: number
    type(c_ptr), intent(in) :: handle
    integer(c_int32_t), intent(inout) :: status
    if (status /= rsc_success) return
    number = rsc_number_of(handle)
    if (number == 0) status = rsc_no_memory
  end subroutine

  function last_message() result(text)
    character(:), allocatable :: text
    character(kind=c_char) :: buffer(4096)
    integer(c_int64_t) :: length
    text = ''
    if (rsc_message(buffer, size(buffer, kind=c_int64_t), length) == rsc_success) then
      text = joined(buffer, length)
    end if
  end function

  !> The version of the library.
  function rsc_library_version(stat, errmsg) result(text)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: text
    character(kind=c_char) :: buffer(64)
    integer(c_int64_t) :: length
    length = 0
    call finish(rsc_version(buffer, size(buffer, kind=c_int64_t), length), stat, errmsg)
    text = joined(buffer, length)
  end function

  !> The names of all keys, 'group%key', padded with blanks, as for get, set and ./rsc --describe.
  function rsc_keys(stat, errmsg) result(names)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: names(:)
    character(kind=c_char) :: buffer(64)
    integer(c_int64_t) :: n, k, length
    integer(c_int32_t) :: status
    n = 0
    status = rsc_key_count(n)
    allocate (character(64) :: names(n))
    do k = 1, n
      length = 0
      if (status == rsc_success) then
        status = rsc_key_name(k - 1, buffer, size(buffer, kind=c_int64_t), length)
      end if
      names(k) = joined(buffer, length)
    end do
    call finish(status, stat, errmsg)
  end function

  function joined(buffer, length) result(text)
    character(kind=c_char), intent(in) :: buffer(:)
    integer(c_int64_t), intent(in) :: length
    character(:), allocatable :: text
    integer :: i, n
    n = int(min(length, size(buffer, kind=c_int64_t)))
    allocate (character(n) :: text)
    do i = 1, n
      text(i:i) = buffer(i)
    end do
  end function

  function terminated(text) result(chars)
    character(*), intent(in) :: text
    character(kind=c_char) :: chars(len(text) + 1)
    integer :: i
    do i = 1, len(text)
      chars(i) = text(i:i)
    end do
    chars(len(text) + 1) = c_null_char
  end function

  ! --- case ---------------------------------------------------------------------------------------

  !> The handle of the case for changing, created if there is none yet.
  subroutine case_ready(self, handle, status)
    class(rsc_case), intent(inout) :: self
    type(c_ptr), intent(out) :: handle
    integer(c_int32_t), intent(out) :: status
    status = rsc_success
    if (self%number == 0) then
      handle = c_null_ptr
      status = rsc_case_create(handle)
      call keep(self%number, handle, status)
    end if
    handle = rsc_handle_of(self%number)
  end subroutine

  !> The handle of the case for reading; if nothing was set, a temporary case of defaults, to be
  !> destroyed afterwards.
  subroutine case_as_is(self, handle, defaults, status)
    class(rsc_case), intent(in) :: self
    type(c_ptr), intent(out) :: handle, defaults
    integer(c_int32_t), intent(out) :: status
    status = rsc_success
    defaults = c_null_ptr
    handle = rsc_handle_of(self%number)
    if (self%number /= 0) return
    status = rsc_case_create(defaults)
    handle = defaults
  end subroutine

  subroutine case_set_text(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name, value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    call case_ready(self, handle, status)
    if (status == rsc_success) then
      status = rsc_case_set(handle, terminated(trim(name)), terminated(value))
    end if
    call finish(status, stat, errmsg)
  end subroutine

  !> Runs the case and calls `watch` about ten times a second; stat is rsc_stopped if it stopped the
  !> run. data: for watch; resume: .true. continues an interrupted campaign (rsc_case_resume).
  subroutine case_run_watched(self, watch, data, failed_levels, resume, stat, errmsg)
    class(rsc_case), intent(in) :: self
    procedure(rsc_watch) :: watch
    type(c_ptr), intent(in), optional :: data
    integer(c_int64_t), intent(inout), optional :: failed_levels
    logical, intent(in), optional :: resume
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle, defaults, given
    logical :: continued
    given = c_null_ptr
    if (present(data)) given = data
    continued = .false.
    if (present(resume)) continued = resume
    call case_as_is(self, handle, defaults, status)
    if (status == rsc_success .and. continued) then
      status = rsc_case_resume(handle, c_funloc(watch), given, failed_levels)
    else if (status == rsc_success) then
      status = rsc_case_run_watched(handle, c_funloc(watch), given, failed_levels)
    end if
    call finish(status, stat, errmsg)
    status = rsc_case_destroy(defaults)
  end subroutine

  !> A number in namelist syntax, exact to the last bit.
  elemental function of_real(value) result(text)
    real(c_double), intent(in) :: value
    character(32) :: text
    write (text, '(es32.16e4)') value
    text = adjustl(text)
  end function

  !> The shortest decimal number that equals this one in single precision.
  elemental function of_single(value) result(text)
    real(c_float), intent(in) :: value
    character(32) :: text, form
    real(c_float) :: back
    integer :: digits, problem
    do digits = 5, 8
      write (form, '(a,i0,a)') '(es32.', digits, 'e4)'
      write (text, form) value
      read (text, *, iostat=problem) back
      if (problem == 0 .and. back >= value .and. back <= value) exit
    end do
    text = adjustl(text)
  end function

  elemental function of_integer(value) result(text)
    integer(c_int64_t), intent(in) :: value
    character(32) :: text
    write (text, '(i0)') value
  end function

  !> A list of numbers in namelist syntax.
  function listed(numbers) result(text)
    character(*), intent(in) :: numbers(:)
    character(:), allocatable :: text
    integer :: i
    text = ''
    do i = 1, size(numbers)
      text = text // ' ' // trim(numbers(i))
    end do
  end function

  subroutine case_set_real(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_double), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, trim(of_real(value)), stat, errmsg)
  end subroutine

  subroutine case_set_single(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_float), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, trim(of_single(value)), stat, errmsg)
  end subroutine

  subroutine case_set_reals(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_double), intent(in) :: value(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, listed(of_real(value)), stat, errmsg)
  end subroutine

  subroutine case_set_singles(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_float), intent(in) :: value(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, listed(of_single(value)), stat, errmsg)
  end subroutine

  subroutine case_set_integers(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, listed(of_integer(int(value, c_int64_t))), stat, errmsg)
  end subroutine

  subroutine case_set_long(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    integer(c_int64_t), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, trim(of_integer(value)), stat, errmsg)
  end subroutine

  subroutine case_set_integer(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, trim(of_integer(int(value, c_int64_t))), stat, errmsg)
  end subroutine

  subroutine case_set_logical(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    logical, intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, merge('.true. ', '.false.', value), stat, errmsg)
  end subroutine

  !> The value of a key in namelist syntax, as for set; empty if the key is not set.
  function case_get(self, name, stat, errmsg) result(value)
    class(rsc_case), intent(in) :: self
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: value
    value = case_as_text(self, name, stat, errmsg)
  end function

  !> Sets all keys from namelist text; keys that are not in it get their defaults.
  subroutine case_read(self, text, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: text
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    call case_ready(self, handle, status)
    if (status == rsc_success) status = rsc_case_read(handle, terminated(text))
    call finish(status, stat, errmsg)
  end subroutine

  !> Sets all keys from a namelist file.
  subroutine case_read_file(self, path, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    call case_ready(self, handle, status)
    if (status == rsc_success) status = rsc_case_read_file(handle, terminated(trim(path)))
    call finish(status, stat, errmsg)
  end subroutine

  !> All keys as namelist text.
  function case_text(self, stat, errmsg) result(text)
    class(rsc_case), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: text
    text = case_as_text(self, stat=stat, errmsg=errmsg)
  end function

  !> The value of the key `name`, or without a name all keys.
  function case_as_text(self, name, stat, errmsg) result(text)
    class(rsc_case), intent(in) :: self
    character(*), intent(in), optional :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: text
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_int64_t) :: length
    integer(c_int32_t) :: status, ignored
    type(c_ptr) :: handle, defaults
    text = ''
    length = 16383
    call case_as_is(self, handle, defaults, status)
    do while (status == rsc_success)
      if (allocated(buffer)) deallocate (buffer)
      allocate (buffer(length + 1))
      if (present(name)) then
        status = rsc_case_get(handle, terminated(trim(name)), buffer, &
                              size(buffer, kind=c_int64_t), length)
      else
        status = rsc_case_text(handle, buffer, size(buffer, kind=c_int64_t), length)
      end if
      if (status /= rsc_success .or. length >= size(buffer, kind=c_int64_t)) cycle
      text = joined(buffer, length)
      exit
    end do
    ignored = rsc_case_destroy(defaults)
    call finish(status, stat, errmsg)
  end function

  !> Runs the case as the program does and writes its result file.
  subroutine case_run(self, failed_levels, stat, errmsg)
    class(rsc_case), intent(in) :: self
    integer, intent(out), optional :: failed_levels
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status, ignored
    type(c_ptr) :: handle, defaults
    integer(c_int64_t) :: failed
    failed = 0
    call case_as_is(self, handle, defaults, status)
    if (status == rsc_success) status = rsc_case_run(handle, failed)
    if (present(failed_levels)) failed_levels = int(failed)
    ignored = rsc_case_destroy(defaults)
    call finish(status, stat, errmsg)
  end subroutine

  function options_of(options) result(handle)
    class(rsc_case), intent(in), optional :: options
    type(c_ptr) :: handle
    handle = c_null_ptr  ! the defaults
    if (present(options)) handle = rsc_handle_of(options%number)
  end function

  ! --- surface ------------------------------------------------------------------------------------

  !> A surface of heights z(i,j), measured from z = 0; periodic: .false. by default.
  subroutine surface_take(self, z, dx, dy, x0, y0, periodic, stat, errmsg)
    class(rsc_surface), intent(inout) :: self
    real(c_double), intent(in) :: z(:,:)
    real(c_double), intent(in) :: dx
    real(c_double), intent(in), optional :: dy, x0, y0
    logical, intent(in), optional :: periodic
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status, wraps
    type(c_ptr) :: handle
    real(c_double) :: step_y, first_x, first_y
    step_y = dx
    if (present(dy)) step_y = dy
    first_x = 0
    if (present(x0)) first_x = x0
    first_y = 0
    if (present(y0)) first_y = y0
    wraps = 0
    if (present(periodic)) wraps = merge(1_c_int32_t, 0_c_int32_t, periodic)
    call self%free()
    handle = c_null_ptr
    status = rsc_surface_take(handle, size(z, 1, c_int64_t), size(z, 2, c_int64_t), dx, step_y, &
                              first_x, first_y, wraps, z)
    call keep(self%number, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  subroutine surface_grid(self, nx, ny, dx, dy, x0, y0, periodic, stat, errmsg)
    class(rsc_surface), intent(in) :: self
    integer, intent(out), optional :: nx, ny
    real(c_double), intent(out), optional :: dx, dy, x0, y0
    logical, intent(out), optional :: periodic
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(2)
    integer(c_int32_t) :: status, wraps
    n = 0
    wraps = 0
    status = rsc_surface_grid(rsc_handle_of(self%number), n(1), n(2), dx, dy, x0, y0, wraps)
    if (present(nx)) nx = int(n(1))
    if (present(ny)) ny = int(n(2))
    if (present(periodic)) periodic = wraps == 1
    call finish(status, stat, errmsg)
  end subroutine

  !> The heights, z(nx,ny).
  subroutine surface_heights(self, z, stat, errmsg)
    class(rsc_surface), intent(in) :: self
    real(c_double), intent(out), contiguous, target :: z(:,:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: nx, ny
    integer(c_int32_t) :: status
    type(difference) :: unlike
    status = rsc_surface_grid(rsc_handle_of(self%number), nx, ny)
    if (status == rsc_success) then
      call compare(3, 'z', shape(z), int([nx, ny]), unlike)
      if (refused('surface%heights', unlike, stat, errmsg)) return
      status = rsc_surface_heights(rsc_handle_of(self%number), size(z, kind=c_int64_t), z)
    end if
    call finish(status, stat, errmsg)
  end subroutine

  ! --- asperities ---------------------------------------------------------------------------------

  ! --- contact ------------------------------------------------------------------------------------

  !> Z0 of the last level.
  function contact_separation(self, stat, errmsg) result(separation)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: separation
    separation = 0
    call finish(rsc_contact_result(rsc_handle_of(self%number), separation=separation), stat, errmsg)
  end function

  !> N of the last level.
  function contact_force(self, stat, errmsg) result(force)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: force
    force = 0
    call finish(rsc_contact_result(rsc_handle_of(self%number), force=force), stat, errmsg)
  end function

  !> A of the last level.
  function contact_area(self, stat, errmsg) result(area)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: area
    area = 0
    call finish(rsc_contact_result(rsc_handle_of(self%number), area=area), stat, errmsg)
  end function

  !> Number of asperities in contact.
  function contact_contacts(self, stat, errmsg) result(n)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: n
    integer(c_int64_t) :: contacts
    contacts = 0
    call finish(rsc_contact_result(rsc_handle_of(self%number), contacts=contacts), stat, errmsg)
    n = int(contacts)
  end function

  !> The contacts of the last level: number of the asperity, force, contact radius, penetration.
  subroutine contact_spots(self, asperity, force, radius, penetration, stat, errmsg)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), allocatable, optional :: asperity(:)
    real(c_double), intent(out), allocatable, optional :: force(:), radius(:), penetration(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    integer(c_int64_t) :: n
    ! An argument that is absent may not be handed on as allocatable; an array that is not allocated
    ! may, and is absent then.
    real(c_double), allocatable :: force_(:), radius_(:), penetration_(:)
    integer(c_int32_t), allocatable :: which(:)
    integer :: problem
    n = 0
    status = rsc_contact_result(rsc_handle_of(self%number), contacts=n)
    problem = 0
    if (status == rsc_success) allocate (which(n), stat=problem)
    if (problem /= 0) status = rsc_no_memory
    if (.not. allocated(which)) allocate (which(0))
    if (present(force)) call make_room(force_, n, status)
    if (present(radius)) call make_room(radius_, n, status)
    if (present(penetration)) call make_room(penetration_, n, status)
    if (status == rsc_success) then
      status = rsc_contact_spots(rsc_handle_of(self%number), n, which, force_, radius_, &
                                 penetration_)
    end if
    if (present(force)) call move_alloc(force_, force)
    if (present(radius)) call move_alloc(radius_, radius)
    if (present(penetration)) call move_alloc(penetration_, penetration)
    if (present(asperity)) asperity = int(which) + 1
    call finish(status, stat, errmsg)
  end subroutine

  !> Force, radius and penetration of every asperity, 0 where there is no contact; the arrays have
  !> the size of the number of asperities.
  subroutine contact_per_asperity(self, force, radius, penetration, stat, errmsg)
    class(rsc_contact), intent(in) :: self
    real(c_double), intent(out), contiguous, optional :: force(:), radius(:), penetration(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(difference) :: unlike
    integer(c_int64_t) :: n
    n = 0
    if (present(penetration)) n = size(penetration, kind=c_int64_t)
    if (present(radius)) n = size(radius, kind=c_int64_t)
    if (present(force)) n = size(force, kind=c_int64_t)
    if (present(radius)) call compare(4, 'radius', shape(radius), [int(n)], unlike)
    if (present(penetration)) call compare(5, 'penetration', shape(penetration), [int(n)], unlike)
    if (refused('contact%per_asperity', unlike, stat, errmsg)) return
    call finish(rsc_contact_per_asperity(rsc_handle_of(self%number), n, force, radius, &
                                         penetration), stat, errmsg)
  end subroutine

  !> Presses many contacts with a force each, distributed among threads (0: all of the machine);
  !> returns the separations and statuses of press.
  subroutine rsc_press_all(contacts, force, separation, threads, each, stat, errmsg)
    type(rsc_contact), intent(inout) :: contacts(:)
    real(c_double), intent(in) :: force(:)
    real(c_double), intent(inout), contiguous :: separation(:)
    integer, intent(in), optional :: threads
    integer(c_int32_t), intent(inout), contiguous, optional :: each(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handles(size(contacts))
    type(difference) :: unlike
    call compare(3, 'force', shape(force), shape(contacts), unlike)
    call compare(4, 'separation', shape(separation), shape(contacts), unlike)
    if (present(each)) call compare(5, 'each', shape(each), shape(contacts), unlike)
    if (refused('rsc_press_all', unlike, stat, errmsg)) return
    handles = handles_of(contacts)
    call finish(rsc_contacts_press(size(contacts, kind=c_int64_t), handles, force, separation, &
                                   each, team_of(threads)), stat, errmsg)
  end subroutine

  !> Indents many contacts to a separation each, distributed among threads (0: all of the machine);
  !> returns the forces and statuses of indent.
  subroutine rsc_indent_all(contacts, separation, force, threads, each, stat, errmsg)
    type(rsc_contact), intent(inout) :: contacts(:)
    real(c_double), intent(in) :: separation(:)
    real(c_double), intent(inout), contiguous :: force(:)
    integer, intent(in), optional :: threads
    integer(c_int32_t), intent(inout), contiguous, optional :: each(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handles(size(contacts))
    type(difference) :: unlike
    call compare(3, 'separation', shape(separation), shape(contacts), unlike)
    call compare(4, 'force', shape(force), shape(contacts), unlike)
    if (present(each)) call compare(5, 'each', shape(each), shape(contacts), unlike)
    if (refused('rsc_indent_all', unlike, stat, errmsg)) return
    handles = handles_of(contacts)
    call finish(rsc_contacts_indent(size(contacts, kind=c_int64_t), handles, separation, force, &
                                    each, team_of(threads)), stat, errmsg)
  end subroutine

  !> A step of many contacts: moves tips to (x0, y0), then applies a force (by_force) or a
  !> separation to each; returns the requested results.
  subroutine rsc_step_all(contacts, by_force, value, x0, y0, separation, force, stiffness, &
                          lateral_x, lateral_y, moment_x, moment_y, level_status, threads, each, &
                          stat, errmsg)
    type(rsc_contact), intent(inout) :: contacts(:)
    logical, intent(in) :: by_force
    real(c_double), intent(in) :: value(:)
    real(c_double), intent(in), contiguous, optional :: x0(:), y0(:)
    real(c_double), intent(inout), contiguous, optional :: separation(:), force(:), stiffness(:), &
        lateral_x(:), lateral_y(:)
    real(c_double), intent(inout), contiguous, optional :: moment_x(:), moment_y(:)
    integer(c_int32_t), intent(inout), contiguous, optional :: level_status(:), each(:)
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handles(size(contacts))
    type(difference) :: unlike
    integer :: n(1)
    n = shape(contacts)
    call compare(6, 'value', shape(value), n, unlike)
    if (present(x0)) call compare(3, 'x0', shape(x0), n, unlike)
    if (present(y0)) call compare(4, 'y0', shape(y0), n, unlike)
    if (present(separation)) call compare(7, 'separation', shape(separation), n, unlike)
    if (present(force)) call compare(8, 'force', shape(force), n, unlike)
    if (present(stiffness)) call compare(9, 'stiffness', shape(stiffness), n, unlike)
    if (present(lateral_x)) call compare(10, 'lateral_x', shape(lateral_x), n, unlike)
    if (present(lateral_y)) call compare(11, 'lateral_y', shape(lateral_y), n, unlike)
    if (present(moment_x)) call compare(12, 'moment_x', shape(moment_x), n, unlike)
    if (present(moment_y)) call compare(13, 'moment_y', shape(moment_y), n, unlike)
    if (present(level_status)) call compare(14, 'level_status', shape(level_status), n, unlike)
    if (present(each)) call compare(15, 'each', shape(each), n, unlike)
    if (refused('rsc_step_all', unlike, stat, errmsg)) return
    handles = handles_of(contacts)
    call finish(rsc_contacts_step(size(contacts, kind=c_int64_t), handles, x0, y0, &
                                  merge(1_c_int32_t, 0_c_int32_t, by_force), value, separation, &
                                  force, stiffness, lateral_x, lateral_y, moment_x, moment_y, &
                                  level_status, each, team_of(threads)), stat, errmsg)
  end subroutine

  function handles_of(contacts) result(handles)
    type(rsc_contact), intent(inout) :: contacts(:)
    type(c_ptr) :: handles(size(contacts))
    integer :: i
    do i = 1, size(contacts)
      handles(i) = rsc_handle_of(contacts(i)%number)
    end do
  end function

  integer(c_int32_t) function team_of(threads)
    integer, intent(in), optional :: threads
    team_of = 0
    if (present(threads)) team_of = int(threads, c_int32_t)
  end function

  ! --- friction -----------------------------------------------------------------------------------

  !> m = 4 G*/E* of two bodies, the ratio of tangential to normal stiffness, from Young's moduli
  !> (infinite: rigid) and Poisson's ratios.
  function rsc_stiffness_ratio(E, nu, stat, errmsg) result(ratio)
    real(c_double), intent(in) :: E(2), nu(2)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: ratio
    ratio = 0
    call finish(rsc_tangential_ratio(E, nu, ratio), stat, errmsg)
  end function

  !> Tangential stiffness for a further slide in the present direction of slip: k(i, j) = dQ_i/dx_j.
  function friction_stiffness(self, stat, errmsg) result(k)
    class(rsc_friction), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: k(2, 2)
    k = 0
    call finish(rsc_friction_stiffness(rsc_handle_of(self%number), k(1, 1), k(1, 2), k(2, 1), &
                                       k(2, 2)), stat, errmsg)
  end function

  !> The spots of the last update: number of the asperity, contact radius, radius of the stick area,
  !> share of Q.
  subroutine friction_spots(self, asperity, radius, stick_radius, force_x, force_y, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    integer, intent(out), allocatable, optional :: asperity(:)
    real(c_double), intent(out), allocatable, optional :: radius(:), stick_radius(:), force_x(:), &
        force_y(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    integer(c_int64_t) :: n
    ! An argument that is absent may not be handed on as allocatable; an array that is not allocated
    ! may, and is absent then.
    real(c_double), allocatable :: radius_(:), stick_radius_(:), force_x_(:), force_y_(:)
    integer(c_int32_t), allocatable :: which(:)
    n = 0
    ! asks for the number only
    status = rsc_friction_spots(rsc_handle_of(self%number), 0_c_int64_t, count=n)
    allocate (which(n))
    if (present(radius)) allocate (radius_(n))
    if (present(stick_radius)) allocate (stick_radius_(n))
    if (present(force_x)) allocate (force_x_(n))
    if (present(force_y)) allocate (force_y_(n))
    if (n > 0) status = rsc_friction_spots(rsc_handle_of(self%number), n, n, which, &
        & radius_, stick_radius_, force_x_, force_y_)
    if (present(radius)) call move_alloc(radius_, radius)
    if (present(stick_radius)) call move_alloc(stick_radius_, stick_radius)
    if (present(force_x)) call move_alloc(force_x_, force_x)
    if (present(force_y)) call move_alloc(force_y_, force_y)
    if (present(asperity)) asperity = int(which) + 1
    call finish(status, stat, errmsg)
  end subroutine

  ! --- procedures that only call their C function -------------------------------------------------

  include 'generated/wrappers.inc'

end module rsc
