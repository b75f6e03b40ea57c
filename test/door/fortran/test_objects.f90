! Objects of the module inside types of the user's own. However the compiler copies them, the copies
! are names of one object; after its release every one of them is an error status, and an own copy
! is not.
module particles
  use rsc
  implicit none
  type :: particle
    integer :: id = 0
    real :: x = 0
    type(rsc_contact) :: c
  end type
  type, extends(particle) :: ball
    real :: mass = 1
  end type
contains
  ! A single asperity at x, with the tip above it.
  subroutine set(c, x)
    type(rsc_contact), intent(inout) :: c
    double precision, intent(in) :: x
    type(rsc_asperities) :: a
    call a%take([x], [0.0d0], [0.0d0], [1.0d0])
    call c%create(a, 2.0d5, 5.0d0, x, 0.0d0)
    call a%free()
  end subroutine
  function made(id, x) result(p)
    integer, intent(in) :: id
    double precision, intent(in) :: x
    type(particle) :: p
    p%id = id
    call set(p%c, x)
  end function
end module

program test_objects
  use particles
  implicit none
  integer :: failures = 0
  call names_of_one_object()
  call lists()
  call memory()
  call threads()
  call sizes()
  print '(i0,a)', failures, ' failed'
  if (failures > 0) error stop 'test_objects'

contains

  include 'check.inc'

  ! Its tip is at x, and it works: Hertz at a penetration of 1e-3.
  subroutine works(c, x, what)
    type(rsc_contact), intent(inout) :: c
    double precision, intent(in) :: x
    character(*), intent(in) :: what
    double precision :: x0, N
    integer :: stat
    character(300) :: errmsg
    x0 = -1
    errmsg = ''
    call c%tip(x0, stat=stat, errmsg=errmsg)
    call check(stat == 0 .and. abs(x0 - x) < 1d-12, what // ': tip ' // trim(errmsg))
    if (stat /= 0) return
    call c%indent(-1d-3, N, stat)
    call check(stat == 0 .and. abs(N / (4 / 3d0 * 2d5 * 1d-3**1.5d0) - 1) < 1d-9, what // ': force')
  end subroutine

  subroutine is_gone(c, what)
    type(rsc_contact), intent(inout) :: c
    character(*), intent(in) :: what
    integer :: stat
    character(300) :: errmsg
    call c%indent(-1d-3, stat=stat, errmsg=errmsg)
    call check(stat == -1 .and. index(errmsg, 'contact') > 0, what // ' after the release')
  end subroutine

  ! Every way in which a compiler copies an object bit by bit, before and after the object is
  ! released.
  subroutine names_of_one_object()
    type(particle) :: p, q, own, made_here
    type(particle), allocatable :: r, s
    class(particle), allocatable :: any, other
    double precision :: x0
    p = made(1, 1d0)
    q = p
    r = p
    made_here = particle(1, 2.0, p%c)
    allocate (s, source=p)
    allocate (ball :: any)
    any%c = p%c
    allocate (other, source=any)
    call works(q%c, 1d0, 'q = p')
    call works(r%c, 1d0, 'allocatable r = p')
    call works(made_here%c, 1d0, 'constructor')
    call works(s%c, 1d0, 'allocate(s, source=p)')
    call works(other%c, 1d0, 'polymorphic')
    own = p
    call own%c%copy(own%c)
    call q%c%move_tip(1.5d0, 0d0)
    call p%c%tip(x0)
    call check(abs(x0 - 1.5d0) < 1d-12, 'p is q')
    call works(own%c, 1d0, 'its own copy')
    call p%c%free()
    call is_gone(p%c, 'p')
    call is_gone(q%c, 'q')
    call is_gone(r%c, 'r')
    call is_gone(made_here%c, 'constructor')
    call is_gone(s%c, 's')
    call is_gone(other%c, 'polymorphic')
    call q%c%free()
    call set(q%c, 2d0)  ! may lie where the released one lay
    call is_gone(r%c, 'r, and another object created')
    call works(q%c, 2d0, 'q, created again')
    call q%c%copy(own%c)
    call works(q%c, 1d0, 'q, a copy over another object')
    call own%c%free()
    call q%c%free()
  end subroutine

  subroutine lists()
    type(particle), allocatable :: list(:), longer(:)
    type(particle) :: p
    integer :: i
    allocate (list(0))
    do i = 1, 8
      call set(p%c, 1d0 * i)
      if (mod(i, 2) == 0) then
        list = [list, p]
      else
        allocate (longer(i))
        longer(:i - 1) = list
        longer(i) = p
        call move_alloc(longer, list)
      end if
      p = particle()
    end do
    list(1:2) = list(2:1:-1)
    call works(list(1)%c, 2d0, 'swapped')
    call works(list(2)%c, 1d0, 'swapped')
    do i = 3, 8
      call works(list(i)%c, 1d0 * i, 'a list that grew')
    end do
    do i = 1, 8
      call list(i)%c%free()
    end do
  end subroutine

  ! Assignments take no memory, and a copy over a copy releases the former.
  subroutine memory()
    type(rsc_contact) :: c, d, e
    integer :: k, before
    call set(c, 0d0)
    do k = 1, 3000
      if (k == 1000) before = resident()
      call d%copy(c)
      e = d
      d = e
    end do
    call check(resident() - before < 500, 'memory grows')
    call c%free()
    call d%free()
  end subroutine

  integer function resident()  ! kB
    integer :: unit, ios
    integer(8) :: pages
    resident = 0
    open (newunit=unit, file='/proc/self/statm', action='read', status='old', iostat=ios)
    if (ios /= 0) return
    read (unit, *) pages, resident
    close (unit)
    resident = 4 * resident
  end function

  subroutine threads()
    type(rsc_contact) :: c, own
    double precision :: N(8), x(8)
    integer :: i
    call set(c, 0d0)
    N = 0
    !$omp parallel do firstprivate(c) private(own) num_threads(4) schedule(static, 1)
    do i = 1, 8
      own = c
      call own%copy(c)
      call own%move_tip(1d-3 * i, 0d0)
      call own%tip(x(i))
      call own%indent(-1d-3, N(i))
      call own%free()
    end do
    call check(all(abs(x - [(1d-3 * i, i = 1, 8)]) < 1d-15), 'a copy for each thread: tips')
    call check(all(N > 0) .and. all(N(2:) < N(:7)), 'a copy for each thread: forces')
    call works(c, 0d0, 'the original')
    call c%free()
  end subroutine
  ! Sizes that do not belong together are refused by the number of the argument in rsc.h, its name
  ! and both shapes.
  subroutine sizes()
    type(rsc_contact) :: c(2)
    type(rsc_surface) :: map
    double precision :: w(4) = 0, z(3,4)
    integer :: stat
    character(300) :: errmsg
    call set(c(1), 1d0)
    call c(1)%indent(-1d-3)
    call c(1)%deflection([1d0, 2d0, 3d0, 4d0], [0d0, 0d0, 0d0], w, stat, errmsg)
    call check(stat == -4 .and. index(errmsg, 'y (number 4') > 0 .and. &
               index(errmsg, '(3), not (4)') > 0, 'size of y: ' // trim(errmsg))
    call rsc_press_all(c, [1d0, 2d0], w(:1), stat=stat, errmsg=errmsg)
    call check(stat == -4 .and. index(errmsg, '(1), not (2)') > 0, &
               'size of a list: ' // trim(errmsg))
    call map%take(reshape([(w, stat = 1, 5)], [5, 4]), 0.1d0)
    call map%heights(z, stat, errmsg)
    call check(stat == -3 .and. index(errmsg, '(3,4), not (5,4)') > 0, 'shape: ' // trim(errmsg))
    call map%free(stat, errmsg)
    call c(1)%free(stat, errmsg)
    call check(stat == 0, 'free')
  end subroutine

end program
