! The Fortran module: what only Fortran has. Values by every type, failures told and not told,
! copies, finalisers.
program test_api
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int32_t, c_int64_t
  implicit none
  real(dp), parameter :: E = 2.0e5_dp, u = 1.0e-3_dp
  integer :: failures = 0

  call options_by_name()
  call lifetimes()
  print '(i0,a)', failures, ' failed'
  if (failures > 0) error stop 'test_api'

contains

  include 'check.inc'

  subroutine options_by_name()
    type(rsc_case) :: options, other
    character(200) :: errmsg, text
    integer :: stat
    real :: single
    call options%set('surface%sigma', 0.02_dp)
    call options%set('surface%n', 4096)
    call options%set('surface%plateau', .true.)
    call options%set('solver%method', "'direct'")
    call check(options%get('surface%sigma') == '0.02', 'real by name')
    call check(options%get('Surface%N ') == '4096', 'integer by name')
    call check(options%get('surface%plateau') == '.true.', 'logical by name')
    call check(options%get('solver%method') == "'direct'", 'text by name')
    call other%read(options%text())
    call check(other%text() == options%text(), 'case as text and back')
    call options%set('surface%sigma', 0.1)
    call check(options%get('surface%sigma') == '0.1', 'default real by name, as written')
    call options%set('surface%sigma', 1.0 / 3)
    text = options%get('surface%sigma')
    read (text, *) single
    call check(single == 1.0 / 3, 'default real by name, every bit of it')
    call options%set('run%seed', 9000000000_c_int64_t)
    call check(options%get('run%seed') == '9000000000', 'long integer by name')
    call options%set('solids%E', [1.0e5_dp, 2.0e5_dp])
    call check(options%get('solids%E') == '1e+05, 2e+05', 'array by name')
    call options%set('solids%nu', [0.3, 0.25])
    call check(options%get('solids%nu') == '0.3, 0.25', 'default real array by name')
    call options%set('indentation%levels', [3, 2, 1])
    call check(options%get('indentation%levels') == '3.0, 2.0, 1.0', 'integer array by name')
    call options%set('solids%E', 1.0_dp, stat, errmsg)
    call check(stat < 0 .and. index(errmsg, 'solids%E(1)') > 0, 'one value for two')
    call options%set('solids%E(1)', 1.0_dp / 3)  ! every bit of it
    call other%copy(options)
    call options%set('solids%E(1)', 2.0_dp)
    call check(other%get('solids%E(1)') == '0.3333333333333333', 'a copied case is its own')
    errmsg = 'untouched'
    call options%set('surface%n', 128, stat, errmsg)
    call check(stat == 0 .and. errmsg == 'untouched', 'errmsg keeps its value without failure')
    call options%set('surface%simga', 1, stat, errmsg)
    call check(stat < 0 .and. index(errmsg, 'sigma') > 0, 'unknown name')
    call options%read('&surface n = 64 /', stat)
    call check(stat < 0 .and. options%get('surface%n') == '128', 'a refused text changes nothing')
    call check(index(rsc_library_version(), '.') > 0, 'version')
    call options%free()
    call other%free()
  end subroutine

  ! Objects created, created again and released: a leak or a double release shows under valgrind or
  ! AddressSanitizer.
  subroutine lifetimes()
    integer :: k
    do k = 1, 50
      call one_life(k)
    end do
  end subroutine

  subroutine one_life(k)
    integer, intent(in) :: k
    type(rsc_asperities) :: asperities
    type(rsc_contact) :: contact, other
    real(dp) :: N, M
    call asperities%take([1.0_dp * k], [0.0_dp], [0.0_dp], [1.0_dp])
    call contact%create(asperities, E, 10.0_dp, 1.0_dp * k, 0.0_dp)
    call other%copy(contact)
    call asperities%take([0.0_dp], [0.0_dp], [0.0_dp], [1.0_dp])
    call contact%create(asperities, E, 10.0_dp, 0.0_dp, 0.0_dp)
    call contact%indent(-u, N)
    call asperities%free()
    call asperities%free()
    call other%indent(-u, M)
    call check(abs(M - N) <= 1e-10_dp * N, 'copies outlive what they came from')
    call contact%free()
    call other%free()
  end subroutine
end program
