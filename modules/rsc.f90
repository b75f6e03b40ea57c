!> rsc in Fortran: the contact of a sphere with a rough surface of asperities. The same as rsc.h, which says more about every argument.
!>
!>     use rsc
!>     type(rsc_asperities) :: asperities
!>     type(rsc_contact) :: contact
!>     call asperities%take(x, y, z, radius)
!>     call contact%create(asperities, E_star=94.7d3, R=2.5d0, x0=0.5d0, y0=0.5d0)
!>     call contact%indent(separation=0.02d0, force=N)
!>     print *, N, contact%area(), contact%stiffness()
!>
!> Objects release what they hold when they go out of scope; creating one again releases what it held before, and assignment copies
!> (a copied contact has the same asperities, sphere and options, and no result yet: one for another thread). Different
!> objects may be used by different threads at the same time.
!>
!> In types of your own, and in parallel regions. An object knows its place; what a compiler copied bit by bit shows the original as long
!> as that exists, gets its own (a copied contact without result) when it is changed, releases nothing that is not its own, and says so
!> in errmsg when the original is gone. So these work: q = p and q = particle(1, x, contact) for types that hold objects, allocate with
!> source=, functions that return such types, lists that grow element by element (longer(i) = list(i), then move_alloc), firstprivate
!> and private. gfortran 12 leaves no way for whole arrays of such types: after list = [list, p] the elements may hold nothing (told in
!> errmsg), and longer(1:n) = list crashes in code of its own; use loops there, or hold a pointer in the type:
!>     type(rsc_contact), pointer :: contact => null()    ! allocate(p%contact); assignment copies the pointer; deallocate it once
!> What private leaves behind is released when its place is used again. Arrays of objects themselves may be assigned with gfortran 12,
!> too, where `use rsc` is without only.
!>
!> Every procedure takes stat and errmsg like the statements of the language: with stat, a failure is told there (negative: an argument
!> is wrong; positive: one of the rsc_* codes) and in errmsg, which otherwise keeps its value; without stat, a failure is an error stop
!> with the message. After a failure functions return 0, allocatable arrays have size 0, and other outputs are undefined, except with
!> stat = rsc_not_converged. Asperities count from 1.
module rsc
  use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_associated, c_char, c_null_char, c_double, c_float, &
    c_int32_t, c_int64_t
  implicit none
  private
  public :: rsc_case, rsc_surface, rsc_asperities, rsc_contact, rsc_friction, rsc_library_version
  public :: rsc_stiffness_ratio, rsc_press_all, rsc_indent_all

  !> Status codes.
  integer, parameter, public :: rsc_success = 0
  integer, parameter, public :: rsc_not_converged = 1
  integer, parameter, public :: rsc_no_memory = 2
  integer, parameter, public :: rsc_file = 3
  integer, parameter, public :: rsc_no_result = 4
  integer, parameter, public :: rsc_internal = 5
  !> What is to be said about a level.
  integer, parameter, public :: rsc_level_converged = 0
  integer, parameter, public :: rsc_level_out_of_validity = 1
  integer, parameter, public :: rsc_level_overlapping = 2
  integer, parameter, public :: rsc_level_not_unique = 3
  integer, parameter, public :: rsc_level_not_converged = 4

  !> Options by the names of the namelist, 'group%key'; all at their defaults to begin with.
  type :: rsc_case
    private
    integer(c_int64_t) :: ticket = 0
  contains
    !> set(name, value): value is a real or an integer of either usual kind, an array of them, a logical, or text in namelist syntax
    !> (with its quotes where it is a text). A default real is taken as the shortest decimal number it stands for: 0.1 is 0.1.
    generic :: set => set_text, set_real, set_single, set_integer, set_long, set_logical, set_reals, set_singles, set_integers
    procedure :: get => case_get
    procedure :: read => case_read
    procedure :: read_file => case_read_file
    procedure :: text => case_text
    procedure :: run => case_run
    generic :: assignment(=) => copy
    procedure, private :: set_text => case_set_text
    procedure, private :: set_real => case_set_real
    procedure, private :: set_single => case_set_single
    procedure, private :: set_integer => case_set_integer
    procedure, private :: set_long => case_set_long
    procedure, private :: set_reals => case_set_reals
    procedure, private :: set_singles => case_set_singles
    procedure, private :: set_integers => case_set_integers
    procedure, private :: set_logical => case_set_logical
    procedure, private :: copy => case_copy
    final :: case_final
  end type

  !> Heights z(i,j) at x0 + (i-1) dx, y0 + (j-1) dy.
  type :: rsc_surface
    private
    integer(c_int64_t) :: ticket = 0
  contains
    procedure :: synthesize => surface_synthesize
    procedure :: take => surface_take
    procedure :: detrend => surface_detrend
    procedure :: filter => surface_filter
    procedure :: grid => surface_grid
    procedure :: heights => surface_heights
    procedure :: moments => surface_moments
    generic :: assignment(=) => copy
    procedure, private :: copy => surface_copy
    final :: surface_final
  end type

  !> Summits: positions and radii.
  type :: rsc_asperities
    private
    integer(c_int64_t) :: ticket = 0
  contains
    procedure :: find => asperities_find
    procedure :: make => asperities_make
    procedure :: take => asperities_take
    procedure :: count => asperities_count
    procedure :: get => asperities_get
    procedure :: curvatures => asperities_curvatures
    generic :: assignment(=) => copy
    procedure, private :: copy => asperities_copy
    final :: asperities_final
  end type

  !> A sphere on asperities, and the last level computed.
  type :: rsc_contact
    private
    integer(c_int64_t) :: ticket = 0
    integer(c_int64_t) :: asperities = 0
  contains
    procedure :: create => contact_create
    procedure :: create_from_case => contact_create_from_case
    procedure :: move_tip => contact_move_tip
    procedure :: tip => contact_tip
    procedure :: first_touch => contact_first_touch
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
    procedure :: spots => contact_spots
    procedure :: per_asperity => contact_per_asperity
    procedure :: deflection => contact_deflection
    procedure :: save => contact_save
    procedure :: restore => contact_restore
    generic :: assignment(=) => copy
    procedure, private :: copy => contact_copy
    final :: contact_final
  end type

  !> A contact with friction, led along any path of separations and slides. Assignment copies the path, too.
  type :: rsc_friction
    private
    integer(c_int64_t) :: ticket = 0
  contains
    procedure :: create => friction_create
    procedure :: create_from_case => friction_create_from_case
    procedure :: update => friction_update
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
    generic :: assignment(=) => copy
    procedure, private :: copy => friction_copy
    final :: friction_final
  end type

  !> What is behind a ticket (tickets.h).
  integer(c_int32_t), parameter :: rsc_kind_case = 1
  integer(c_int32_t), parameter :: rsc_kind_surface = 2
  integer(c_int32_t), parameter :: rsc_kind_asperities = 3
  integer(c_int32_t), parameter :: rsc_kind_contact = 4
  integer(c_int32_t), parameter :: rsc_kind_friction = 5

  !> Whole arrays of objects; a single one is assigned by its type.
  interface assignment(=)
    module procedure cases_set, cases_copy, surfaces_set, surfaces_copy
    module procedure asperities_set, asperities_copy_each, contacts_set, contacts_copy, frictions_set, frictions_copy
  end interface
  public :: assignment(=)

  ! The functions of rsc.h, name by name and argument by argument; a test compares them with it. What they give back keeps its value
  ! when they fail: intent(inout), for after intent(out) a compiler may take it for lost.
  interface
    function rsc_version(buffer, size, length) bind(c) result(code)
      import :: c_char, c_int32_t, c_int64_t
      character(kind=c_char), intent(inout) :: buffer(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout), optional :: length
      integer(c_int32_t) :: code
    end function
    function rsc_message(buffer, size, length) bind(c) result(code)
      import :: c_char, c_int32_t, c_int64_t
      character(kind=c_char), intent(inout) :: buffer(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout), optional :: length
      integer(c_int32_t) :: code
    end function
    function rsc_status_text(status, buffer, size, length) bind(c) result(code)
      import :: c_char, c_int32_t, c_int64_t
      integer(c_int32_t), value :: status
      character(kind=c_char), intent(inout) :: buffer(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout), optional :: length
      integer(c_int32_t) :: code
    end function
    function rsc_case_create(new_case) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: new_case
      integer(c_int32_t) :: code
    end function
    function rsc_case_copy(new_case, original) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: new_case
      type(c_ptr), value :: original
      integer(c_int32_t) :: code
    end function
    function rsc_case_destroy(old_case) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: old_case
      integer(c_int32_t) :: code
    end function
    function rsc_case_read(a_case, text) bind(c) result(code)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: a_case
      character(kind=c_char), intent(in) :: text(*)
      integer(c_int32_t) :: code
    end function
    function rsc_case_read_file(a_case, path) bind(c) result(code)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: a_case
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: code
    end function
    function rsc_case_set(a_case, name, value) bind(c) result(code)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: a_case
      character(kind=c_char), intent(in) :: name(*), value(*)
      integer(c_int32_t) :: code
    end function
    function rsc_case_get(a_case, name, buffer, size, length) bind(c) result(code)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: a_case
      character(kind=c_char), intent(in) :: name(*)
      character(kind=c_char), intent(inout) :: buffer(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout), optional :: length
      integer(c_int32_t) :: code
    end function
    function rsc_case_text(a_case, buffer, size, length) bind(c) result(code)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: a_case
      character(kind=c_char), intent(inout) :: buffer(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout), optional :: length
      integer(c_int32_t) :: code
    end function
    function rsc_key_count(count) bind(c) result(code)
      import :: c_int32_t, c_int64_t
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: code
    end function
    function rsc_key_name(key, buffer, size, length) bind(c) result(code)
      import :: c_char, c_int32_t, c_int64_t
      integer(c_int64_t), value :: key
      character(kind=c_char), intent(inout) :: buffer(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout), optional :: length
      integer(c_int32_t) :: code
    end function
    function rsc_case_run(a_case, failed_levels) bind(c) result(code)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: a_case
      integer(c_int64_t), intent(inout), optional :: failed_levels
      integer(c_int32_t) :: code
    end function
    function rsc_surface_synthesize(surface, a_case, realization) bind(c) result(code)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), intent(inout) :: surface
      type(c_ptr), value :: a_case
      integer(c_int64_t), value :: realization
      integer(c_int32_t) :: code
    end function
    function rsc_surface_take(surface, nx, ny, dx, dy, x0, y0, periodic, heights) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), intent(inout) :: surface
      integer(c_int64_t), value :: nx, ny
      real(c_double), value :: dx, dy, x0, y0
      integer(c_int32_t), value :: periodic
      real(c_double), intent(in) :: heights(*)
      integer(c_int32_t) :: code
    end function
    function rsc_surface_copy(surface, original) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: surface
      type(c_ptr), value :: original
      integer(c_int32_t) :: code
    end function
    function rsc_surface_destroy(surface) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: surface
      integer(c_int32_t) :: code
    end function
    function rsc_surface_detrend(surface, how, rms) bind(c) result(code)
      import :: c_char, c_double, c_int32_t, c_ptr
      type(c_ptr), value :: surface
      character(kind=c_char), intent(in) :: how(*)
      real(c_double), intent(inout), optional :: rms
      integer(c_int32_t) :: code
    end function
    function rsc_surface_filter(surface, cutoff) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: surface
      real(c_double), value :: cutoff
      integer(c_int32_t) :: code
    end function
    function rsc_surface_grid(surface, nx, ny, dx, dy, x0, y0, periodic) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: surface
      integer(c_int64_t), intent(inout), optional :: nx, ny
      real(c_double), intent(inout), optional :: dx, dy, x0, y0
      integer(c_int32_t), intent(inout), optional :: periodic
      integer(c_int32_t) :: code
    end function
    function rsc_surface_heights(surface, n, heights) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: surface
      integer(c_int64_t), value :: n
      real(c_double), intent(inout) :: heights(*)
      integer(c_int32_t) :: code
    end function
    function rsc_surface_moments(surface, m0, m2, m4) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: surface
      real(c_double), intent(inout), optional :: m0, m2, m4
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_find(asperities, surface, a_case) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: asperities
      type(c_ptr), value :: surface, a_case
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_make(asperities, a_case, realization) bind(c) result(code)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), intent(inout) :: asperities
      type(c_ptr), value :: a_case
      integer(c_int64_t), value :: realization
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_take(asperities, n, x, y, z, radius, kappa1, kappa2, angle, biharmonic) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), intent(inout) :: asperities
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: x(*), y(*), z(*), radius(*)
      real(c_double), intent(in), optional :: kappa1(*), kappa2(*), angle(*), biharmonic(*)
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_copy(asperities, original) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: asperities
      type(c_ptr), value :: original
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_destroy(asperities) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: asperities
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_count(asperities, n) bind(c) result(code)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: asperities
      integer(c_int64_t), intent(inout) :: n
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_get(asperities, n, x, y, z, radius) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: asperities
      integer(c_int64_t), value :: n
      real(c_double), intent(inout), optional :: x(*), y(*), z(*), radius(*)
      integer(c_int32_t) :: code
    end function
    function rsc_asperities_curvatures(asperities, n, kappa1, kappa2, angle) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: asperities
      integer(c_int64_t), value :: n
      real(c_double), intent(inout), optional :: kappa1(*), kappa2(*), angle(*)
      integer(c_int32_t) :: code
    end function
    function rsc_contact_create(contact, asperities, E_star, R, x0, y0, a_case) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: contact
      type(c_ptr), value :: asperities
      real(c_double), value :: E_star, R, x0, y0
      type(c_ptr), value :: a_case
      integer(c_int32_t) :: code
    end function
    function rsc_contact_create_from_case(contact, asperities, a_case) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: contact
      type(c_ptr), value :: asperities, a_case
      integer(c_int32_t) :: code
    end function
    function rsc_contact_copy(contact, original) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: contact
      type(c_ptr), value :: original
      integer(c_int32_t) :: code
    end function
    function rsc_contact_destroy(contact) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: contact
      integer(c_int32_t) :: code
    end function
    function rsc_contact_move_tip(contact, x0, y0) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), value :: x0, y0
      integer(c_int32_t) :: code
    end function
    function rsc_contact_tip(contact, x0, y0) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), intent(inout), optional :: x0, y0
      integer(c_int32_t) :: code
    end function
    function rsc_contact_first_touch(contact, separation) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), intent(inout) :: separation
      integer(c_int32_t) :: code
    end function
    function rsc_contact_indent(contact, separation, force) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), value :: separation
      real(c_double), intent(inout), optional :: force
      integer(c_int32_t) :: code
    end function
    function rsc_contact_press(contact, force, separation) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), value :: force
      real(c_double), intent(inout), optional :: separation
      integer(c_int32_t) :: code
    end function
    function rsc_contact_result(contact, separation, force, area, contacts) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), intent(inout), optional :: separation, force, area
      integer(c_int64_t), intent(inout), optional :: contacts
      integer(c_int32_t) :: code
    end function
    function rsc_contact_level(contact, level_status, candidates, iterations, overlapping_pairs, residual) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int32_t), intent(inout), optional :: level_status
      integer(c_int64_t), intent(inout), optional :: candidates, iterations, overlapping_pairs
      real(c_double), intent(inout), optional :: residual
      integer(c_int32_t) :: code
    end function
    function rsc_contact_answer(contact, separation, force, stiffness, area, energy, lateral_x, lateral_y, level_status, contacts, &
                                overlapping_pairs, large_contacts, beyond_law, edge_contacts) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), intent(inout), optional :: separation, force, stiffness, area, energy, lateral_x, lateral_y
      integer(c_int32_t), intent(inout), optional :: level_status
      integer(c_int64_t), intent(inout), optional :: contacts, overlapping_pairs, large_contacts, beyond_law, edge_contacts
      integer(c_int32_t) :: code
    end function
    function rsc_contact_value(contact, name, value) bind(c) result(code)
      import :: c_char, c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(inout) :: value
      integer(c_int32_t) :: code
    end function
    function rsc_contact_stiffness(contact, stiffness) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), intent(inout) :: stiffness
      integer(c_int32_t) :: code
    end function
    function rsc_contact_energy(contact, energy) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      real(c_double), intent(inout) :: energy
      integer(c_int32_t) :: code
    end function
    function rsc_contact_spots(contact, n, asperity, force, radius, penetration) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: n
      integer(c_int32_t), intent(inout), optional :: asperity(*)
      real(c_double), intent(inout), optional :: force(*), radius(*), penetration(*)
      integer(c_int32_t) :: code
    end function
    function rsc_contact_per_asperity(contact, n, force, radius, penetration) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: n
      real(c_double), intent(inout), optional :: force(*), radius(*), penetration(*)
      integer(c_int32_t) :: code
    end function
    function rsc_contact_deflection(contact, n, x, y, deflection) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: x(*), y(*)
      real(c_double), intent(inout) :: deflection(*)
      integer(c_int32_t) :: code
    end function
    ! Of tickets.h: what stands behind the tickets that the objects hold.
    function rsc_ticket_issue(ticket, kind, handle) bind(c) result(code)
      import :: c_int32_t, c_int64_t, c_ptr
      integer(c_int64_t), intent(inout) :: ticket
      integer(c_int32_t), value :: kind
      type(c_ptr), value :: handle
      integer(c_int32_t) :: code
    end function
    function rsc_ticket_read(ticket, handle) bind(c) result(code)
      import :: c_int32_t, c_int64_t, c_ptr
      integer(c_int64_t), intent(in) :: ticket
      type(c_ptr), intent(inout) :: handle
      integer(c_int32_t) :: code
    end function
    function rsc_ticket_change(ticket, handle) bind(c) result(code)
      import :: c_int32_t, c_int64_t, c_ptr
      integer(c_int64_t), intent(inout) :: ticket
      type(c_ptr), intent(inout) :: handle
      integer(c_int32_t) :: code
    end function
    function rsc_ticket_copy(ticket, original) bind(c) result(code)
      import :: c_int32_t, c_int64_t
      integer(c_int64_t), intent(inout) :: ticket
      integer(c_int64_t), intent(in) :: original
      integer(c_int32_t) :: code
    end function
    function rsc_ticket_release(ticket) bind(c) result(code)
      import :: c_int32_t, c_int64_t
      integer(c_int64_t), intent(inout) :: ticket
      integer(c_int32_t) :: code
    end function
    function rsc_contacts_press(n, contacts, force, separation, status, threads) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      integer(c_int64_t), value :: n
      type(c_ptr), intent(inout) :: contacts(*)
      real(c_double), intent(in) :: force(*)
      real(c_double), intent(inout), optional :: separation(*)
      integer(c_int32_t), intent(inout), optional :: status(*)
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: code
    end function
    function rsc_contacts_indent(n, contacts, separation, force, status, threads) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      integer(c_int64_t), value :: n
      type(c_ptr), intent(inout) :: contacts(*)
      real(c_double), intent(in) :: separation(*)
      real(c_double), intent(inout), optional :: force(*)
      integer(c_int32_t), intent(inout), optional :: status(*)
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: code
    end function
    function rsc_contact_save(contact, path) bind(c) result(code)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: code
    end function
    function rsc_contact_restore(contact, asperities, path) bind(c) result(code)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: contact
      type(c_ptr), value :: asperities
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: code
    end function
    function rsc_friction_save(friction, path) bind(c) result(code)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: friction
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: code
    end function
    function rsc_friction_restore(friction, asperities, path) bind(c) result(code)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: friction
      type(c_ptr), value :: asperities
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: code
    end function
    function rsc_tangential_ratio(E, nu, ratio) bind(c) result(code)
      import :: c_double, c_int32_t
      real(c_double), intent(in) :: E(*), nu(*)
      real(c_double), intent(inout) :: ratio
      integer(c_int32_t) :: code
    end function
    function rsc_friction_create(friction, contact, mu, ratio) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: friction
      type(c_ptr), value :: contact
      real(c_double), value :: mu, ratio
      integer(c_int32_t) :: code
    end function
    function rsc_friction_create_from_case(friction, contact, a_case) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: friction
      type(c_ptr), value :: contact, a_case
      integer(c_int32_t) :: code
    end function
    function rsc_friction_copy(friction, original) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: friction
      type(c_ptr), value :: original
      integer(c_int32_t) :: code
    end function
    function rsc_friction_destroy(friction) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: friction
      integer(c_int32_t) :: code
    end function
    function rsc_friction_update(friction, separation, x, y, force, force_x, force_y, lost) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: friction
      real(c_double), value :: separation, x, y
      real(c_double), intent(inout), optional :: force, force_x, force_y, lost
      integer(c_int32_t) :: code
    end function
    function rsc_friction_stiffness(friction, xx, xy, yx, yy) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: friction
      real(c_double), intent(inout), optional :: xx, xy, yx, yy
      integer(c_int32_t) :: code
    end function
    function rsc_friction_state(friction, separation, x, y, force, force_x, force_y, energy, tangential_energy, lost, &
        & stick_separation) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: friction
      real(c_double), intent(inout), optional :: separation, x, y, force, force_x, force_y, energy, tangential_energy, lost, &
        & stick_separation
      integer(c_int32_t) :: code
    end function
    function rsc_friction_commit(friction) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), value :: friction
      integer(c_int32_t) :: code
    end function
    function rsc_friction_rollback(friction) bind(c) result(code)
      import :: c_int32_t, c_ptr
      type(c_ptr), value :: friction
      integer(c_int32_t) :: code
    end function
    function rsc_friction_first_loading(friction, n, slide, force, stick_separation) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: friction
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: slide(*)
      real(c_double), intent(inout) :: force(*)
      real(c_double), intent(inout), optional :: stick_separation(*)
      integer(c_int32_t) :: code
    end function
    function rsc_friction_slide(friction, force, slide) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: friction
      real(c_double), value :: force
      real(c_double), intent(inout) :: slide
      integer(c_int32_t) :: code
    end function
    function rsc_friction_full_slip(friction, slide, force) bind(c) result(code)
      import :: c_double, c_int32_t, c_ptr
      type(c_ptr), value :: friction
      real(c_double), intent(inout), optional :: slide, force
      integer(c_int32_t) :: code
    end function
    function rsc_friction_spots(friction, n, count, asperity, radius, stick_radius, force_x, force_y) bind(c) result(code)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: friction
      integer(c_int64_t), value :: n
      integer(c_int64_t), intent(inout), optional :: count
      integer(c_int32_t), intent(inout), optional :: asperity(*)
      real(c_double), intent(inout), optional :: radius(*), stick_radius(*), force_x(*), force_y(*)
      integer(c_int32_t) :: code
    end function
  end interface

contains

  ! --- failures and text ---------------------------------------------------------------------------------------------------------

  !> Tells the caller, or stops.
  subroutine finish(status, stat, errmsg)
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: message
    if (present(stat)) stat = int(status)
    if (status == rsc_success) return
    message = last_message()
    if (status == rsc_no_memory) message = 'the machine refused memory'
    if (index(message, 'must not be null') > 0) then
      message = message // ': nothing was created in the object, or it is a bitwise copy of one that is gone (see rsc.f90)'
    end if
    if (present(stat)) then
      if (present(errmsg)) errmsg = message
    else
      error stop 'rsc: ' // message
    end if
  end subroutine

  !> A mistake found on this side: no function of rsc.h was called.
  subroutine refuse(message, stat, errmsg)
    character(*), intent(in) :: message
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (present(stat)) then
      stat = -1
      if (present(errmsg)) errmsg = message
    else
      error stop 'rsc: ' // message
    end if
  end subroutine

  !> The handle behind a ticket, for reading; null if there is none.
  function reading(ticket) result(handle)
    integer(c_int64_t), intent(in) :: ticket
    type(c_ptr) :: handle
    integer(c_int32_t) :: status
    handle = c_null_ptr
    status = rsc_ticket_read(ticket, handle)
  end function

  !> For changing: an object that shows what another one owns gets its own.
  function changing(ticket) result(handle)
    integer(c_int64_t), intent(inout) :: ticket
    type(c_ptr) :: handle
    integer(c_int32_t) :: status
    handle = c_null_ptr
    status = rsc_ticket_change(ticket, handle)
  end function

  !> Room for n values; none after a failure, so that the array has a size.
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

  !> What a constructor made, if it did.
  subroutine keep(ticket, kind, handle, status)
    integer(c_int64_t), intent(inout) :: ticket
    integer(c_int32_t), intent(in) :: kind
    type(c_ptr), intent(in) :: handle
    integer(c_int32_t), intent(inout) :: status
    if (status == rsc_success) status = rsc_ticket_issue(ticket, kind, handle)
  end subroutine

  function last_message() result(text)
    character(:), allocatable :: text
    character(kind=c_char) :: buffer(4096)
    integer(c_int64_t) :: length
    text = ''
    if (rsc_message(buffer, size(buffer, kind=c_int64_t), length) == rsc_success) text = joined(buffer, length)
  end function

  !> The version of the library.
  function rsc_library_version() result(text)
    character(:), allocatable :: text
    character(kind=c_char) :: buffer(64)
    integer(c_int64_t) :: length
    text = ''
    if (rsc_version(buffer, size(buffer, kind=c_int64_t), length) == rsc_success) text = joined(buffer, length)
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

  ! --- case ------------------------------------------------------------------------------------------------------------------------

  !> The case to be changed, made if there is none yet.
  subroutine case_ready(self, handle, status)
    class(rsc_case), intent(inout) :: self
    type(c_ptr), intent(out) :: handle
    integer(c_int32_t), intent(out) :: status
    status = rsc_success
    handle = changing(self%ticket)
    if (c_associated(handle)) return
    status = rsc_ticket_release(self%ticket)
    status = rsc_case_create(handle)
    call keep(self%ticket, rsc_kind_case, handle, status)
  end subroutine

  !> The case to be read; where nothing was set, one that stands for the defaults, to be destroyed afterwards.
  subroutine case_as_is(self, handle, defaults, status)
    class(rsc_case), intent(in) :: self
    type(c_ptr), intent(out) :: handle, defaults
    integer(c_int32_t), intent(out) :: status
    status = rsc_success
    defaults = c_null_ptr
    handle = reading(self%ticket)
    if (c_associated(handle)) return
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
    if (status == rsc_success) status = rsc_case_set(handle, terminated(trim(name)), terminated(value))
    call finish(status, stat, errmsg)
  end subroutine

  !> A number in namelist syntax, every bit of it.
  function of_real(value) result(text)
    real(c_double), intent(in) :: value
    character(32) :: text
    write (text, '(es32.16e4)') value
    text = adjustl(text)
  end function

  !> The shortest decimal number that is this one in single precision.
  function of_single(value) result(text)
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
    character(:), allocatable :: text
    integer :: i
    text = ''
    do i = 1, size(value)
      text = text // ' ' // trim(of_real(value(i)))
    end do
    call self%set_text(name, text, stat, errmsg)
  end subroutine

  subroutine case_set_singles(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_float), intent(in) :: value(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: text
    integer :: i
    text = ''
    do i = 1, size(value)
      text = text // ' ' // trim(of_single(value(i)))
    end do
    call self%set_text(name, text, stat, errmsg)
  end subroutine

  subroutine case_set_integers(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: text
    character(40) :: one
    integer :: i
    text = ''
    do i = 1, size(value)
      write (one, '(i0)') value(i)
      text = text // ' ' // trim(one)
    end do
    call self%set_text(name, text, stat, errmsg)
  end subroutine

  subroutine case_set_long(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    integer(c_int64_t), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(40) :: text
    write (text, '(i0)') value
    call self%set_text(name, trim(text), stat, errmsg)
  end subroutine

  subroutine case_set_integer(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(40) :: text
    write (text, '(i0)') value
    call self%set_text(name, trim(text), stat, errmsg)
  end subroutine

  subroutine case_set_logical(self, name, value, stat, errmsg)
    class(rsc_case), intent(inout) :: self
    character(*), intent(in) :: name
    logical, intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call self%set_text(name, merge('.true. ', '.false.', value), stat, errmsg)
  end subroutine

  !> The value of a key in namelist syntax, as set takes it; empty if the key is not set.
  function case_get(self, name, stat, errmsg) result(value)
    class(rsc_case), intent(in) :: self
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:), allocatable :: value
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_int64_t) :: length
    integer(c_int32_t) :: status, ignored
    type(c_ptr) :: handle, defaults
    value = ''
    allocate (buffer(4096))
    call case_as_is(self, handle, defaults, status)
    do while (status == rsc_success)
      status = rsc_case_get(handle, terminated(trim(name)), buffer, size(buffer, kind=c_int64_t), length)
      if (status /= rsc_success) exit
      if (length < size(buffer, kind=c_int64_t)) then
        value = joined(buffer, length)
        exit
      end if
      deallocate (buffer)
      allocate (buffer(length + 1))
    end do
    ignored = rsc_case_destroy(defaults)
    call finish(status, stat, errmsg)
  end function

  !> Takes all keys from namelist text, defaults where it says nothing.
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

  !> The same from a file.
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
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_int64_t) :: length
    integer(c_int32_t) :: status, ignored
    type(c_ptr) :: handle, defaults
    text = ''
    allocate (buffer(16384))
    call case_as_is(self, handle, defaults, status)
    do while (status == rsc_success)
      status = rsc_case_text(handle, buffer, size(buffer, kind=c_int64_t), length)
      if (status /= rsc_success) exit
      if (length < size(buffer, kind=c_int64_t)) then
        text = joined(buffer, length)
        exit
      end if
      deallocate (buffer)
      allocate (buffer(length + 1))
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

  subroutine case_copy(self, original)
    class(rsc_case), intent(inout) :: self
    class(rsc_case), intent(in) :: original
    call finish(rsc_ticket_copy(self%ticket, original%ticket))
  end subroutine

  subroutine cases_set(self, original)
    type(rsc_case), intent(inout) :: self(:)
    type(rsc_case), intent(in) :: original
    integer :: i
    do i = 1, size(self)
      call case_copy(self(i), original)
    end do
  end subroutine

  subroutine cases_copy(self, original)
    type(rsc_case), intent(inout) :: self(:)
    type(rsc_case), intent(in) :: original(:)
    integer :: i
    do i = 1, size(self)
      call case_copy(self(i), original(i))
    end do
  end subroutine

  impure elemental subroutine case_final(self)
    type(rsc_case), intent(inout) :: self
    integer(c_int32_t) :: status
    status = rsc_ticket_release(self%ticket)
  end subroutine

  function options_of(options) result(handle)
    class(rsc_case), intent(in), optional :: options
    type(c_ptr) :: handle
    handle = c_null_ptr  ! the defaults
    if (present(options)) handle = reading(options%ticket)
  end function

  ! --- surface -----------------------------------------------------------------------------------------------------------------------

  !> Realization number `realization` by the keys of &surface and run%seed.
  subroutine surface_synthesize(self, options, realization, stat, errmsg)
    class(rsc_surface), intent(inout) :: self
    class(rsc_case), intent(in), optional :: options
    integer, intent(in), optional :: realization
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    integer(c_int64_t) :: number
    number = 1
    if (present(realization)) number = realization
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_surface_synthesize(handle, options_of(options), number)
    call keep(self%ticket, rsc_kind_surface, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  !> Given heights z(i,j), measured from z = 0; periodic: whether the surface wraps around (it does not by default).
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
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_surface_take(handle, size(z, 1, c_int64_t), size(z, 2, c_int64_t), dx, step_y, first_x, first_y, wraps, z)
    call keep(self%ticket, rsc_kind_surface, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  !> Subtracts the 'mean' or the least-squares 'plane', 'quadratic' or 'sphere'; rms: height left.
  subroutine surface_detrend(self, how, rms, stat, errmsg)
    class(rsc_surface), intent(inout) :: self
    character(*), intent(in) :: how
    real(c_double), intent(out), optional :: rms
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_surface_detrend(changing(self%ticket), terminated(trim(how)), rms), stat, errmsg)
  end subroutine

  !> Gaussian low-pass filter (ISO 16610-61): half of a wave of length cutoff is left.
  subroutine surface_filter(self, cutoff, stat, errmsg)
    class(rsc_surface), intent(inout) :: self
    real(c_double), intent(in) :: cutoff
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_surface_filter(changing(self%ticket), cutoff), stat, errmsg)
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
    status = rsc_surface_grid(reading(self%ticket), n(1), n(2), dx, dy, x0, y0, wraps)
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
    status = rsc_surface_grid(reading(self%ticket), nx, ny)
    if (status == rsc_success) then
      if (size(z, 1) /= nx .or. size(z, 2) /= ny) then
        call refuse('the shape of z is not that of the surface', stat, errmsg)
        return
      end if
      status = rsc_surface_heights(reading(self%ticket), size(z, kind=c_int64_t), z)
    end if
    call finish(status, stat, errmsg)
  end subroutine

  !> Spectral moments by finite differences on the grid.
  subroutine surface_moments(self, m0, m2, m4, stat, errmsg)
    class(rsc_surface), intent(in) :: self
    real(c_double), intent(out), optional :: m0, m2, m4
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_surface_moments(reading(self%ticket), m0, m2, m4), stat, errmsg)
  end subroutine

  subroutine surface_copy(self, original)
    class(rsc_surface), intent(inout) :: self
    class(rsc_surface), intent(in) :: original
    call finish(rsc_ticket_copy(self%ticket, original%ticket))
  end subroutine

  subroutine surfaces_set(self, original)
    type(rsc_surface), intent(inout) :: self(:)
    type(rsc_surface), intent(in) :: original
    integer :: i
    do i = 1, size(self)
      call surface_copy(self(i), original)
    end do
  end subroutine

  subroutine surfaces_copy(self, original)
    type(rsc_surface), intent(inout) :: self(:)
    type(rsc_surface), intent(in) :: original(:)
    integer :: i
    do i = 1, size(self)
      call surface_copy(self(i), original(i))
    end do
  end subroutine

  impure elemental subroutine surface_final(self)
    type(rsc_surface), intent(inout) :: self
    integer(c_int32_t) :: status
    status = rsc_ticket_release(self%ticket)
  end subroutine

  ! --- asperities ----------------------------------------------------------------------------------------------------------------------

  !> The summits of a surface.
  subroutine asperities_find(self, surface, options, stat, errmsg)
    class(rsc_asperities), intent(inout) :: self
    class(rsc_surface), intent(in) :: surface
    class(rsc_case), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_asperities_find(handle, reading(surface%ticket), options_of(options))
    call keep(self%ticket, rsc_kind_asperities, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  !> Those of a synthetic surface that is not stored.
  subroutine asperities_make(self, options, realization, stat, errmsg)
    class(rsc_asperities), intent(inout) :: self
    class(rsc_case), intent(in), optional :: options
    integer, intent(in), optional :: realization
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    integer(c_int64_t) :: number
    number = 1
    if (present(realization)) number = realization
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_asperities_make(handle, options_of(options), number)
    call keep(self%ticket, rsc_kind_asperities, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  !> Given ones; kappa1, kappa2 and angle all or none.
  subroutine asperities_take(self, x, y, z, radius, kappa1, kappa2, angle, biharmonic, stat, errmsg)
    class(rsc_asperities), intent(inout) :: self
    real(c_double), intent(in) :: x(:), y(:), z(:), radius(:)
    real(c_double), intent(in), contiguous, optional :: kappa1(:), kappa2(:), angle(:), biharmonic(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    logical :: same
    same = size(y) == size(x) .and. size(z) == size(x) .and. size(radius) == size(x)
    if (present(kappa1)) same = same .and. size(kappa1) == size(x)
    if (present(kappa2)) same = same .and. size(kappa2) == size(x)
    if (present(angle)) same = same .and. size(angle) == size(x)
    if (present(biharmonic)) same = same .and. size(biharmonic) == size(x)
    status = rsc_ticket_release(self%ticket)
    if (.not. same) then
      call refuse('asperities%take: the arrays are not of one size', stat, errmsg)
      return
    end if
    handle = c_null_ptr
    status = rsc_asperities_take(handle, size(x, kind=c_int64_t), x, y, z, radius, kappa1, kappa2, angle, biharmonic)
    call keep(self%ticket, rsc_kind_asperities, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  function asperities_count(self, stat, errmsg) result(n)
    class(rsc_asperities), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: n
    integer(c_int64_t) :: count
    count = 0
    call finish(rsc_asperities_count(reading(self%ticket), count), stat, errmsg)
    n = int(count)
  end function

  subroutine asperities_get(self, x, y, z, radius, stat, errmsg)
    class(rsc_asperities), intent(in) :: self
    real(c_double), intent(out), allocatable, optional :: x(:), y(:), z(:), radius(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    integer(c_int64_t) :: n
    ! An argument that is absent may not be handed on as allocatable; an array that is not allocated may, and is absent then.
    real(c_double), allocatable :: x_(:), y_(:), z_(:), radius_(:)
    n = 0
    status = rsc_asperities_count(reading(self%ticket), n)
    if (present(x)) call make_room(x_, n, status)
    if (present(y)) call make_room(y_, n, status)
    if (present(z)) call make_room(z_, n, status)
    if (present(radius)) call make_room(radius_, n, status)
    if (status == rsc_success) status = rsc_asperities_get(reading(self%ticket), n, x_, y_, z_, radius_)
    if (present(x)) call move_alloc(x_, x)
    if (present(y)) call move_alloc(y_, y)
    if (present(z)) call move_alloc(z_, z)
    if (present(radius)) call move_alloc(radius_, radius)
    call finish(status, stat, errmsg)
  end subroutine

  subroutine asperities_curvatures(self, kappa1, kappa2, angle, stat, errmsg)
    class(rsc_asperities), intent(in) :: self
    real(c_double), intent(out), allocatable, optional :: kappa1(:), kappa2(:), angle(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    integer(c_int64_t) :: n
    ! An argument that is absent may not be handed on as allocatable; an array that is not allocated may, and is absent then.
    real(c_double), allocatable :: kappa1_(:), kappa2_(:), angle_(:)
    n = 0
    status = rsc_asperities_count(reading(self%ticket), n)
    if (present(kappa1)) call make_room(kappa1_, n, status)
    if (present(kappa2)) call make_room(kappa2_, n, status)
    if (present(angle)) call make_room(angle_, n, status)
    if (status == rsc_success) status = rsc_asperities_curvatures(reading(self%ticket), n, kappa1_, kappa2_, angle_)
    if (present(kappa1)) call move_alloc(kappa1_, kappa1)
    if (present(kappa2)) call move_alloc(kappa2_, kappa2)
    if (present(angle)) call move_alloc(angle_, angle)
    call finish(status, stat, errmsg)
  end subroutine

  subroutine asperities_copy(self, original)
    class(rsc_asperities), intent(inout) :: self
    class(rsc_asperities), intent(in) :: original
    call finish(rsc_ticket_copy(self%ticket, original%ticket))
  end subroutine

  subroutine asperities_set(self, original)
    type(rsc_asperities), intent(inout) :: self(:)
    type(rsc_asperities), intent(in) :: original
    integer :: i
    do i = 1, size(self)
      call asperities_copy(self(i), original)
    end do
  end subroutine

  subroutine asperities_copy_each(self, original)
    type(rsc_asperities), intent(inout) :: self(:)
    type(rsc_asperities), intent(in) :: original(:)
    integer :: i
    do i = 1, size(self)
      call asperities_copy(self(i), original(i))
    end do
  end subroutine

  impure elemental subroutine asperities_final(self)
    type(rsc_asperities), intent(inout) :: self
    integer(c_int32_t) :: status
    status = rsc_ticket_release(self%ticket)
  end subroutine

  ! --- contact -------------------------------------------------------------------------------------------------------------------------

  !> A sphere of radius R (infinite: flat) with its tip above (x0, y0), and the equivalent modulus E*.
  subroutine contact_create(self, asperities, E_star, R, x0, y0, options, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    class(rsc_asperities), intent(in) :: asperities
    real(c_double), intent(in) :: E_star, R, x0, y0
    class(rsc_case), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_contact_create(handle, reading(asperities%ticket), E_star, R, x0, y0, options_of(options))
    call keep(self%ticket, rsc_kind_contact, handle, status)
    if (status == rsc_success) status = rsc_asperities_count(reading(asperities%ticket), self%asperities)
    call finish(status, stat, errmsg)
  end subroutine

  !> The same by the keys of &solids and &indentation.
  subroutine contact_create_from_case(self, asperities, options, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    class(rsc_asperities), intent(in) :: asperities
    class(rsc_case), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_contact_create_from_case(handle, reading(asperities%ticket), options_of(options))
    call keep(self%ticket, rsc_kind_contact, handle, status)
    if (status == rsc_success) status = rsc_asperities_count(reading(asperities%ticket), self%asperities)
    call finish(status, stat, errmsg)
  end subroutine

  subroutine contact_move_tip(self, x0, y0, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    real(c_double), intent(in) :: x0, y0
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_contact_move_tip(changing(self%ticket), x0, y0), stat, errmsg)
  end subroutine

  subroutine contact_tip(self, x0, y0, stat, errmsg)
    class(rsc_contact), intent(in) :: self
    real(c_double), intent(out), optional :: x0, y0
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_contact_tip(reading(self%ticket), x0, y0), stat, errmsg)
  end subroutine

  !> Separation at which the sphere, coming down, touches its first asperity.
  function contact_first_touch(self, stat, errmsg) result(separation)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: separation
    separation = 0
    call finish(rsc_contact_first_touch(reading(self%ticket), separation), stat, errmsg)
  end function

  !> The contact at a separation.
  subroutine contact_indent(self, separation, force, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    real(c_double), intent(in) :: separation
    real(c_double), intent(out), optional :: force
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_contact_indent(changing(self%ticket), separation, force), stat, errmsg)
  end subroutine

  !> The contact under a force.
  subroutine contact_press(self, force, separation, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    real(c_double), intent(in) :: force
    real(c_double), intent(out), optional :: separation
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_contact_press(changing(self%ticket), force, separation), stat, errmsg)
  end subroutine

  !> Z0 of the last level.
  function contact_separation(self, stat, errmsg) result(separation)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: separation
    separation = 0
    call finish(rsc_contact_result(reading(self%ticket), separation=separation), stat, errmsg)
  end function

  !> N of the last level.
  function contact_force(self, stat, errmsg) result(force)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: force
    force = 0
    call finish(rsc_contact_result(reading(self%ticket), force=force), stat, errmsg)
  end function

  !> A of the last level.
  function contact_area(self, stat, errmsg) result(area)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: area
    area = 0
    call finish(rsc_contact_result(reading(self%ticket), area=area), stat, errmsg)
  end function

  !> Number of asperities in contact.
  function contact_contacts(self, stat, errmsg) result(n)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: n
    integer(c_int64_t) :: contacts
    contacts = 0
    call finish(rsc_contact_result(reading(self%ticket), contacts=contacts), stat, errmsg)
    n = int(contacts)
  end function

  !> dN/dZ0 of the last level.
  function contact_stiffness(self, stat, errmsg) result(stiffness)
    class(rsc_contact), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: stiffness
    stiffness = 0
    call finish(rsc_contact_stiffness(changing(self%ticket), stiffness), stat, errmsg)
  end function

  !> Elastic energy W of the last level, dW/dZ0 = -N.
  function contact_energy(self, stat, errmsg) result(energy)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: energy
    energy = 0
    call finish(rsc_contact_energy(reading(self%ticket), energy), stat, errmsg)
  end function

  !> How the last level was reached; level_status is one of the rsc_level_* codes.
  subroutine contact_level(self, level_status, candidates, iterations, overlapping_pairs, residual, stat, errmsg)
    class(rsc_contact), intent(in) :: self
    integer, intent(out), optional :: level_status, candidates, iterations, overlapping_pairs
    real(c_double), intent(out), optional :: residual
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status, quality
    integer(c_int64_t) :: n(3)
    quality = 0
    n = 0
    status = rsc_contact_level(reading(self%ticket), quality, n(1), n(2), n(3), residual)
    if (present(level_status)) level_status = int(quality)
    if (present(candidates)) candidates = int(n(1))
    if (present(iterations)) iterations = int(n(2))
    if (present(overlapping_pairs)) overlapping_pairs = int(n(3))
    call finish(status, stat, errmsg)
  end subroutine

  !> The answer of the last level in one call: Z0, N, dN/dZ0, A, W, the lateral force -dW/d(x0, y0), and what there is to say about the
  !> level: how many contacts there are, overlap, are large against the mean spacing, past the range of the law, at the border.
  subroutine contact_answer(self, separation, force, stiffness, area, energy, lateral_x, lateral_y, level_status, contacts, &
                            overlapping_pairs, large_contacts, beyond_law, edge_contacts, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    real(c_double), intent(out), optional :: separation, force, stiffness, area, energy, lateral_x, lateral_y
    integer, intent(out), optional :: level_status, contacts, overlapping_pairs, large_contacts, beyond_law, edge_contacts
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status, quality
    integer(c_int64_t) :: n(5)
    quality = 0
    n = 0
    status = rsc_contact_answer(changing(self%ticket), separation, force, stiffness, area, energy, lateral_x, lateral_y, quality, &
                                n(1), n(2), n(3), n(4), n(5))
    if (present(level_status)) level_status = int(quality)
    if (present(contacts)) contacts = int(n(1))
    if (present(overlapping_pairs)) overlapping_pairs = int(n(2))
    if (present(large_contacts)) large_contacts = int(n(3))
    if (present(beyond_law)) beyond_law = int(n(4))
    if (present(edge_contacts)) edge_contacts = int(n(5))
    call finish(status, stat, errmsg)
  end subroutine

  !> One quantity of the last level by its name in the result file: 'force', 'residual', 'large_contacts', 'lateral_force_x', ...
  function contact_value(self, name, stat, errmsg) result(value)
    class(rsc_contact), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: value
    value = 0
    call finish(rsc_contact_value(changing(self%ticket), terminated(trim(name)), value), stat, errmsg)
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
    ! An argument that is absent may not be handed on as allocatable; an array that is not allocated may, and is absent then.
    real(c_double), allocatable :: force_(:), radius_(:), penetration_(:)
    integer(c_int32_t), allocatable :: which(:)
    integer :: problem
    n = 0
    status = rsc_contact_result(reading(self%ticket), contacts=n)
    problem = 0
    if (status == rsc_success) allocate (which(n), stat=problem)
    if (problem /= 0) status = rsc_no_memory
    if (.not. allocated(which)) allocate (which(0))
    if (present(force)) call make_room(force_, n, status)
    if (present(radius)) call make_room(radius_, n, status)
    if (present(penetration)) call make_room(penetration_, n, status)
    if (status == rsc_success) status = rsc_contact_spots(reading(self%ticket), n, which, force_, radius_, penetration_)
    if (present(force)) call move_alloc(force_, force)
    if (present(radius)) call move_alloc(radius_, radius)
    if (present(penetration)) call move_alloc(penetration_, penetration)
    if (present(asperity)) asperity = int(which) + 1
    call finish(status, stat, errmsg)
  end subroutine

  !> The same for every asperity, 0 where there is no contact; the arrays are as long as there are asperities.
  subroutine contact_per_asperity(self, force, radius, penetration, stat, errmsg)
    class(rsc_contact), intent(in) :: self
    real(c_double), intent(out), contiguous, optional :: force(:), radius(:), penetration(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    logical :: same
    same = .true.
    if (present(force)) same = same .and. size(force) == self%asperities
    if (present(radius)) same = same .and. size(radius) == self%asperities
    if (present(penetration)) same = same .and. size(penetration) == self%asperities
    if (.not. same) then
      call refuse('contact%per_asperity: the size of an array is not the number of asperities', stat, errmsg)
      return
    end if
    call finish(rsc_contact_per_asperity(reading(self%ticket), self%asperities, force, radius, penetration), stat, errmsg)
  end subroutine

  !> The lowering of the surface at points (x, y) by the contact forces.
  subroutine contact_deflection(self, x, y, deflection, stat, errmsg)
    class(rsc_contact), intent(in) :: self
    real(c_double), intent(in) :: x(:), y(:)
    real(c_double), intent(out), contiguous :: deflection(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (size(y) /= size(x) .or. size(deflection) /= size(x)) then
      call refuse('contact%deflection: the arrays are not of one size', stat, errmsg)
      return
    end if
    call finish(rsc_contact_deflection(reading(self%ticket), size(x, kind=c_int64_t), x, y, deflection), stat, errmsg)
  end subroutine

  !> Keeps it in a file; see rsc.h.
  subroutine contact_save(self, path, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_contact_save(changing(self%ticket), terminated(trim(path))), stat, errmsg)
  end subroutine

  !> What a file keeps, on the asperities it was saved with: both go on alike bit for bit.
  subroutine contact_restore(self, asperities, path, stat, errmsg)
    class(rsc_contact), intent(inout) :: self
    class(rsc_asperities), intent(in) :: asperities
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_contact_restore(handle, reading(asperities%ticket), terminated(trim(path)))
    call keep(self%ticket, rsc_kind_contact, handle, status)
    if (status == rsc_success) status = rsc_asperities_count(reading(asperities%ticket), self%asperities)
    call finish(status, stat, errmsg)
  end subroutine

  subroutine contact_copy(self, original)
    class(rsc_contact), intent(inout) :: self
    class(rsc_contact), intent(in) :: original
    self%asperities = original%asperities
    call finish(rsc_ticket_copy(self%ticket, original%ticket))
  end subroutine

  subroutine contacts_set(self, original)
    type(rsc_contact), intent(inout) :: self(:)
    type(rsc_contact), intent(in) :: original
    integer :: i
    do i = 1, size(self)
      call contact_copy(self(i), original)
    end do
  end subroutine

  subroutine contacts_copy(self, original)
    type(rsc_contact), intent(inout) :: self(:)
    type(rsc_contact), intent(in) :: original(:)
    integer :: i
    do i = 1, size(self)
      call contact_copy(self(i), original(i))
    end do
  end subroutine

  impure elemental subroutine contact_final(self)
    type(rsc_contact), intent(inout) :: self
    integer(c_int32_t) :: status
    status = rsc_ticket_release(self%ticket)
  end subroutine

  !> Presses many contacts with a force each, shared out among threads (0: all the machine has); the separations, and what press tells of each.
  subroutine rsc_press_all(contacts, force, separation, threads, each, stat, errmsg)
    type(rsc_contact), intent(inout) :: contacts(:)
    real(c_double), intent(in) :: force(:)
    real(c_double), intent(inout), contiguous :: separation(:)
    integer, intent(in), optional :: threads
    integer(c_int32_t), intent(inout), contiguous, optional :: each(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handles(size(contacts))
    if (.not. of_one_size('rsc_press_all', contacts, force, separation, each, stat, errmsg)) return
    handles = handles_of(contacts)
    call finish(rsc_contacts_press(size(contacts, kind=c_int64_t), handles, force, separation, each, team_of(threads)), stat, &
                errmsg)
  end subroutine

  !> Indents many contacts to a separation each, shared out among threads (0: all the machine has); the forces, and what indent tells of each.
  subroutine rsc_indent_all(contacts, separation, force, threads, each, stat, errmsg)
    type(rsc_contact), intent(inout) :: contacts(:)
    real(c_double), intent(in) :: separation(:)
    real(c_double), intent(inout), contiguous :: force(:)
    integer, intent(in), optional :: threads
    integer(c_int32_t), intent(inout), contiguous, optional :: each(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handles(size(contacts))
    if (.not. of_one_size('rsc_indent_all', contacts, separation, force, each, stat, errmsg)) return
    handles = handles_of(contacts)
    call finish(rsc_contacts_indent(size(contacts, kind=c_int64_t), handles, separation, force, each, team_of(threads)), stat, &
                errmsg)
  end subroutine

  logical function of_one_size(name, contacts, given, answer, each, stat, errmsg)
    character(*), intent(in) :: name
    type(rsc_contact), intent(in) :: contacts(:)
    real(c_double), intent(in) :: given(:), answer(:)
    integer(c_int32_t), intent(in), optional :: each(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    of_one_size = size(given) == size(contacts) .and. size(answer) == size(contacts)
    if (present(each)) of_one_size = of_one_size .and. size(each) == size(contacts)
    if (.not. of_one_size) call refuse(name//': the arrays are not of one size', stat, errmsg)
  end function

  function handles_of(contacts) result(handles)
    type(rsc_contact), intent(inout) :: contacts(:)
    type(c_ptr) :: handles(size(contacts))
    integer :: i
    do i = 1, size(contacts)
      handles(i) = changing(contacts(i)%ticket)
    end do
  end function

  integer(c_int32_t) function team_of(threads)
    integer, intent(in), optional :: threads
    team_of = 0
    if (present(threads)) team_of = int(threads, c_int32_t)
  end function

  ! --- friction ------------------------------------------------------------------------------------------------------------------------

  !> m = 4 G*/E* of two bodies, from their Young's moduli (infinite: rigid) and Poisson's ratios: tangential over normal stiffness.
  function rsc_stiffness_ratio(E, nu, stat, errmsg) result(ratio)
    real(c_double), intent(in) :: E(2), nu(2)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: ratio
    ratio = 0
    call finish(rsc_tangential_ratio(E, nu, ratio), stat, errmsg)
  end function

  !> Friction mu for the asperities, sphere, tip and options of a contact; ratio: m = 4 G*/E* (rsc_stiffness_ratio).
  subroutine friction_create(self, contact, mu, ratio, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    class(rsc_contact), intent(in) :: contact
    real(c_double), intent(in) :: mu, ratio
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_friction_create(handle, reading(contact%ticket), mu, ratio)
    call keep(self%ticket, rsc_kind_friction, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  !> The same by solids%friction, solids%E and solids%nu.
  subroutine friction_create_from_case(self, contact, options, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    class(rsc_contact), intent(in) :: contact
    class(rsc_case), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_friction_create_from_case(handle, reading(contact%ticket), options_of(options))
    call keep(self%ticket, rsc_kind_friction, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  !> Leads the contact on a straight path to (separation, x, y): N, Q along the slide (the sphere is pushed by -Q), work lost on the way.
  subroutine friction_update(self, separation, x, y, force, force_x, force_y, lost, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    real(c_double), intent(in) :: separation, x, y
    real(c_double), intent(out), optional :: force, force_x, force_y, lost
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_friction_update(changing(self%ticket), separation, x, y, force, force_x, force_y, lost), &
        & stat, errmsg)
  end subroutine

  !> dQ/d(x, y) of a further slide the way that slips now: k(i, j) = dQ_i/dx_j.
  function friction_stiffness(self, stat, errmsg) result(k)
    class(rsc_friction), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: k(2, 2)
    k = 0
    call finish(rsc_friction_stiffness(changing(self%ticket), k(1, 1), k(1, 2), k(2, 1), k(2, 2)), stat, errmsg)
  end function

  !> Where the path has led: the last update, its forces, elastic energies (of the normal problem, of the slide), work lost since the
  !> path began, separation whose spots stick.
  subroutine friction_state(self, separation, x, y, force, force_x, force_y, energy, tangential_energy, lost, stick_separation, &
      & stat, errmsg)
    class(rsc_friction), intent(in) :: self
    real(c_double), intent(out), optional :: separation, x, y, force, force_x, force_y, energy, tangential_energy, lost, &
        & stick_separation
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_friction_state(reading(self%ticket), separation, x, y, force, force_x, force_y, energy, tangential_energy, &
        & lost, stick_separation), stat, errmsg)
  end subroutine

  !> Keeps the state for rollback.
  subroutine friction_commit(self, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_friction_commit(changing(self%ticket)), stat, errmsg)
  end subroutine

  !> Back to the last commit.
  subroutine friction_rollback(self, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_friction_rollback(changing(self%ticket)), stat, errmsg)
  end subroutine

  !> Q of a contact pressed to the last separation at rest and then slid by each of the slides; the path is not touched.
  subroutine friction_first_loading(self, slide, force, stick_separation, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    real(c_double), intent(in) :: slide(:)
    real(c_double), intent(out), contiguous :: force(:)
    real(c_double), intent(out), contiguous, optional :: stick_separation(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    logical :: same
    same = size(force) == size(slide)
    if (present(stick_separation)) same = same .and. size(stick_separation) == size(slide)
    if (.not. same) then
      call refuse('friction%first_loading: the arrays are not of one size', stat, errmsg)
      return
    end if
    call finish(rsc_friction_first_loading(changing(self%ticket), size(slide, kind=c_int64_t), slide, force, &
        & stick_separation), stat, errmsg)
  end subroutine

  !> The slide that takes the force Q on first loading.
  function friction_slide(self, force, stat, errmsg) result(slide)
    class(rsc_friction), intent(inout) :: self
    real(c_double), intent(in) :: force
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: slide
    slide = 0
    call finish(rsc_friction_slide(changing(self%ticket), force, slide), stat, errmsg)
  end function

  !> The slide at which all slips on first loading, and the force mu N.
  subroutine friction_full_slip(self, slide, force, stat, errmsg)
    class(rsc_friction), intent(in) :: self
    real(c_double), intent(out), optional :: slide, force
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_friction_full_slip(reading(self%ticket), slide, force), stat, errmsg)
  end subroutine

  !> The spots of the last update: number of the asperity, radius of the spot and of its part that sticks, share of Q.
  subroutine friction_spots(self, asperity, radius, stick_radius, force_x, force_y, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    integer, intent(out), allocatable, optional :: asperity(:)
    real(c_double), intent(out), allocatable, optional :: radius(:), stick_radius(:), force_x(:), force_y(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    integer(c_int64_t) :: n
    ! An argument that is absent may not be handed on as allocatable; an array that is not allocated may, and is absent then.
    real(c_double), allocatable :: radius_(:), stick_radius_(:), force_x_(:), force_y_(:)
    integer(c_int32_t), allocatable :: which(:)
    n = 0
    status = rsc_friction_spots(changing(self%ticket), 0_c_int64_t, count=n)  ! asks for the number only
    allocate (which(n))
    if (present(radius)) allocate (radius_(n))
    if (present(stick_radius)) allocate (stick_radius_(n))
    if (present(force_x)) allocate (force_x_(n))
    if (present(force_y)) allocate (force_y_(n))
    if (n > 0) status = rsc_friction_spots(changing(self%ticket), n, n, which, &
        & radius_, stick_radius_, force_x_, force_y_)
    if (present(radius)) call move_alloc(radius_, radius)
    if (present(stick_radius)) call move_alloc(stick_radius_, stick_radius)
    if (present(force_x)) call move_alloc(force_x_, force_x)
    if (present(force_y)) call move_alloc(force_y_, force_y)
    if (present(asperity)) asperity = int(which) + 1
    call finish(status, stat, errmsg)
  end subroutine

  !> Keeps it in a file; see rsc.h.
  subroutine friction_save(self, path, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call finish(rsc_friction_save(changing(self%ticket), terminated(trim(path))), stat, errmsg)
  end subroutine

  !> What a file keeps, on the asperities it was saved with: both go on alike bit for bit.
  subroutine friction_restore(self, asperities, path, stat, errmsg)
    class(rsc_friction), intent(inout) :: self
    class(rsc_asperities), intent(in) :: asperities
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    status = rsc_ticket_release(self%ticket)
    handle = c_null_ptr
    status = rsc_friction_restore(handle, reading(asperities%ticket), terminated(trim(path)))
    call keep(self%ticket, rsc_kind_friction, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  subroutine friction_copy(self, original)
    class(rsc_friction), intent(inout) :: self
    class(rsc_friction), intent(in) :: original
    call finish(rsc_ticket_copy(self%ticket, original%ticket))
  end subroutine

  subroutine frictions_set(self, original)
    type(rsc_friction), intent(inout) :: self(:)
    type(rsc_friction), intent(in) :: original
    integer :: i
    do i = 1, size(self)
      call friction_copy(self(i), original)
    end do
  end subroutine

  subroutine frictions_copy(self, original)
    type(rsc_friction), intent(inout) :: self(:)
    type(rsc_friction), intent(in) :: original(:)
    integer :: i
    do i = 1, size(self)
      call friction_copy(self(i), original(i))
    end do
  end subroutine

  impure elemental subroutine friction_final(self)
    type(rsc_friction), intent(inout) :: self
    integer(c_int32_t) :: status
    status = rsc_ticket_release(self%ticket)
  end subroutine

end module rsc
