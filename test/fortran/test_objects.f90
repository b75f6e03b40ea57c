! Objects of the module inside types of the user's own, and copied by compilers in ways the module does not see: never a double release,
! never a crash, and where there is a value it is the right one. Run with a number, one way alone.
module particles
  use rsc
  implicit none
  type :: particle
    integer :: id = 0
    real :: x = 0
    type(rsc_contact) :: c
  end type
contains
  ! A single asperity at x, with the tip above it.
  subroutine set(c, x)
    type(rsc_contact), intent(inout) :: c
    double precision, intent(in) :: x
    type(rsc_asperities) :: a
    call a%take([x], [0.0d0], [0.0d0], [1.0d0])
    call c%create(a, 2.0d5, 5.0d0, x, 0.0d0)
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
  call assignment_of_a_type()
  call constructor()
  call from_function()
  call sourced()
  call growing()
  call threads()
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

  subroutine assignment_of_a_type()
    type(particle) :: p, q
    type(particle), allocatable :: r
    integer :: k
    call set(p%c, 1d0)
    call set(q%c, 2d0)
    call works(q%c, 2d0, 'before')
    do k = 1, 3
      q = p
    end do
    call works(q%c, 1d0, 'q = p')
    call works(p%c, 1d0, 'p after q = p')
    call q%c%move_tip(1.5d0, 0d0)
    call works(p%c, 1d0, 'p after q moved')
    r = p
    call works(r%c, 1d0, 'allocatable r = p')
    q = q
  end subroutine

  subroutine constructor()
    type(particle) :: q
    type(rsc_contact) :: a, b
    call set(a, 3d0)
    b = a
    q = particle(1, 2.0, a)
    call works(q%c, 3d0, 'particle(1, x, a)')
    q = particle(2, 2.0, b)
    call works(q%c, 3d0, 'particle(1, x, b), b a copy')
    call works(b, 3d0, 'b')
    call works(a, 3d0, 'a')
  end subroutine

  subroutine from_function()
    type(particle) :: p
    p = made(1, 4d0)
    call works(p%c, 4d0, 'p = made()')
    p = made(2, 5d0)
    call works(p%c, 5d0, 'p = made() again')
  end subroutine

  subroutine sourced()
    type(particle), allocatable :: q, r
    type(particle) :: p
    double precision :: x0
    integer :: stat
    call set(p%c, 6d0)
    allocate (q, source=p)
    allocate (r, source=p)
    call works(q%c, 6d0, 'allocate(q, source=p)')
    call q%c%move_tip(6.5d0, 0d0)
    call works(p%c, 6d0, 'p')
    call p%c%move_tip(6.2d0, 0d0)
    x0 = 6
    call r%c%tip(x0, stat=stat)
    call check(stat /= 0 .or. abs(x0 - 6) < 1d-12, 'a copy bit by bit does not follow its original')
  end subroutine

  ! One element longer, element by element: works with every compiler.
  subroutine append(list, x)
    type(particle), allocatable, intent(inout) :: list(:)
    double precision, intent(in) :: x
    type(particle), allocatable :: longer(:)
    type(particle) :: p
    integer :: i
    call set(p%c, x)
    allocate (longer(size(list) + 1))
    do i = 1, size(list)
      longer(i) = list(i)
    end do
    longer(size(list) + 1) = p
    call move_alloc(longer, list)
  end subroutine

  subroutine growing()
    type(particle), allocatable :: list(:)
    integer :: i
    allocate (list(0))
    do i = 1, 8
      call append(list, 1d0 * i)
      call scribble()
    end do
    do i = 1, 8
      call works(list(i)%c, 1d0 * i, 'a list grown by loops')
    end do
    call append(list, 9d0)
    do i = 9, 1, -1
      call works(list(i)%c, 1d0 * i, 'a list grown once more')
    end do
  end subroutine

  ! Uses the stack that the finished procedure used.
  subroutine scribble()
    type(particle) :: other(3)
    integer :: i
    do i = 1, 3
      call set(other(i)%c, -1d0)
    end do
  end subroutine

  subroutine threads()
    type(rsc_contact) :: c, own
    double precision :: N(8), x(8)
    integer :: i
    logical :: openmp
    openmp = .false.
    !$ openmp = .true.
    call set(c, 0d0)
    N = 0
    !$omp parallel do firstprivate(c) num_threads(4) schedule(static, 1)
    do i = 1, 8
      call c%move_tip(1d-3 * i, 0d0)
      call c%tip(x(i))
      call c%indent(-1d-3, N(i))
    end do
    call check(all(abs(x - [(1d-3 * i, i = 1, 8)]) < 1d-15), 'firstprivate: tips')
    call check(all(N > 0) .and. all(N(2:) < N(:7)), 'firstprivate')
    if (openmp) call works(c, 0d0, 'what firstprivate copied')
    call c%move_tip(0d0, 0d0)
    N = 0
    !$omp parallel do private(own) num_threads(4) schedule(static, 1)
    do i = 1, 8
      own = c
      call own%indent(-1d-3, N(i))
    end do
    call check(all(abs(N - N(1)) <= 1d-9 * N(1)) .and. N(1) > 0, 'private')
    N = 0
    !$omp parallel do private(own) num_threads(4) schedule(static, 1)
    do i = 1, 8
      call set(own, 1d0 * i)
      call own%indent(-1d-3, N(i))
    end do
    call check(all(abs(N - N(1)) <= 1d-9 * N(1)) .and. N(1) > 0, 'private, created')
  end subroutine
end program
