! rsc and this compiler's runtime read the same namelists: what both take has the same values, bit
! for bit. The runtime is the judge of the syntax; rsc may refuse more (a key given twice, a
! misspelt group), and a few things it takes the runtime does not.
program test_namelist
  use rsc
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int64_t
  implicit none
  real(dp) :: E(2), nu(2), R(2), sigma, hurst, L_lambda_s, pdf_levels(100)
  real(dp) :: start, stop, centre(2)
  integer :: n
  integer(c_int64_t) :: seed
  logical :: plateau
  character(1024) :: title
  namelist /solids/ E, nu, R
  namelist /surface/ sigma, hurst, L_lambda_s, n, plateau
  namelist /run/ title, seed
  namelist /output/ pdf_levels
  namelist /indentation/ start, stop, centre
  ! '|' ends a line.
  character(*), parameter :: texts(*) = [character(100) :: &
    '&surface sigma = 2d-2 hurst=.75, n = 4096; plateau = T l_lambda_s = 1.28+2 /', &
    'A title, after Smith|! &surface sigma = 7 /|&SURFACE Sigma=3E-3 ! rms|  hurst = 5.e-1 /', &
    '$solids r = 5, 1*, nu(2) = .3  e(1:2) = 2.1d5, 7.8d4 $end', '&solids E = ,7.5 /', &
    '&solids R = 1*, 9.5 nu = ,.25 /', '&solids E = 7.5,, nu = 0.3 /', &
    '&solids nu(1:2) = ,0.25 /', '&solids R(2) = ,| E = 3.5 /', &
    '&solids R = inf, +Infinity E(:)=1,2 /', &
    '&solids E(2:) = 4.9e-3 nu( 1 ) = -0.0 nu(+2:2) = 1.25q-1 /', &
    '&solids R=2*2.5||! a remark|| E = 1.5e3 ,|   2.5d+3 /', &
    '&indentation centre = ,0.25 stop = 2. /', '&indentation centre = 0.25,, stop = 2. /', &
    '&indentation start=-1.5+1, stop = 3-1 /', &
    '&indentation start = 0.1e-99 stop=17976931348623157.0e30 /', &
    '&indentation start = 123456789.987654321d-4|stop|=|7 /', '&output pdf_levels = ,,9.5 /', &
    '&output pdf_levels = 1.5,,9.5 /', '&output pdf_levels = 2*,9.5 /', &
    '&output pdf_levels = , ,| , 9.5 /', '&output pdf_levels = 3*1.5, 2*0.25 /', &
    '&output pdf_levels(1:4) = 4, 3, 2, 1 /', '&output pdf_levels(1:3)=0.1	0.2	0.3/', &
    '&run title = ''it''''s| two lines'' seed=9223372036854775807 /', &
    '&run title="a ""b"" /c/ ! no remark", seed = -12 &end', &
    '&run seed = +007 title = ''ab cd '' /', &
    '&run seed=3 /|&surface n=8192, plateau=.true. /', '&surface plateau=tfoo n=+4096 /', &
    '&surface plateau = .F, n=2048 / &solids nu=2*.25 /', '&surface|| hurst|  =|  ! so|  .5|/']
  integer :: k, at, differ = 0, compared = 0, taken = 0

  do k = 1, size(texts)
    if (both(trim(texts(k)))) then
      taken = taken + 1
    else
      print '(2a)', 'not taken by both: ', trim(texts(k))
      differ = differ + 1
    end if
    do at = 1, len_trim(texts(k))  ! the same with one character lost, or doubled
      if (both(texts(k)(:at - 1) // trim(texts(k)(at + 1:)))) compared = compared + 1
      if (scan(texts(k)(at:at), '&$') > 0) cycle  ! rsc begins a group at the second of two
      if (both(texts(k)(:at) // trim(texts(k)(at:)))) compared = compared + 1
    end do
  end do
  print '(3(i0,a))', taken, ' texts and ', compared, ' damaged ones are taken by both, ', differ, &
    ' differ'
  if (differ > 0 .or. compared < 700) error stop 'test_namelist'

contains

  ! Whether both take the text; then their values are compared.
  logical function both(text)
    character(*), intent(in) :: text
    type(rsc_case) :: c, defaults
    character(len(text)) :: whole
    character(:), allocatable :: got
    character(1024) :: of_rsc
    integer(c_int64_t) :: theirs
    integer :: stat, i, unit, ios(5), begin
    whole = text
    do i = 1, len(text)
      if (text(i:i) == '|') whole(i:i) = new_line('a')
    end do
    call c%read(whole, stat)
    both = .false.
    if (stat /= 0) return
    call defaults_of(defaults)
    open (newunit=unit, status='scratch')
    begin = 1
    ! Line by line, and two more: a group that closes on the last line of a file is the end of the
    ! file to gfortran.
    do i = 1, len(text)
      if (text(i:i) == '|' .or. i == len(text)) then
        write (unit, '(a)') text(begin:merge(i - 1, i, text(i:i) == '|'))
        begin = i + 1
      end if
    end do
    write (unit, '(a)') '', ''
    rewind (unit)
    read (unit, nml=solids, iostat=ios(1))
    rewind (unit)
    read (unit, nml=surface, iostat=ios(2))
    rewind (unit)
    read (unit, nml=run, iostat=ios(3))
    rewind (unit)
    read (unit, nml=output, iostat=ios(4))
    rewind (unit)
    read (unit, nml=indentation, iostat=ios(5))
    close (unit)
    ! What rsc takes and the runtime does not: queries, commas too many, a remark straight after a
    ! key.
    if (any(ios > 0)) return
    both = .true.
    call same_reals(c, 'solids%E', E, text)
    call same_reals(c, 'solids%nu', nu, text)
    call same_reals(c, 'solids%R', R, text)
    call same_reals(c, 'surface%sigma', [sigma], text)
    call same_reals(c, 'surface%hurst', [hurst], text)
    call same_reals(c, 'surface%L_lambda_s', [L_lambda_s], text)
    call same_reals(c, 'indentation%start', [start], text)
    call same_reals(c, 'indentation%stop', [stop], text)
    call same_reals(c, 'indentation%centre', centre, text)
    call same_reals(c, 'output%pdf_levels', pdf_levels, text)
    call same_reals(c, 'surface%n', [real(n, dp)], text)
    if (plateau .neqv. index(c%get('surface%plateau'), 't') == 2) call told('surface%plateau', text)
    got = c%get('run%seed')
    read (got, *) theirs
    if (theirs /= seed) call told('run%seed', text)
    got = c%get('run%title')
    read (got, *) of_rsc
    if (of_rsc /= title) call told('run%title', text)
  end function

  subroutine told(key, text)
    character(*), intent(in) :: key, text
    differ = differ + 1
    print '(4a)', key, ' differs in: ', text
  end subroutine

  ! Values the text does not give are unset, or the defaults.
  subroutine defaults_of(c)
    type(rsc_case), intent(inout) :: c
    sigma = ieee_value(sigma, ieee_quiet_nan)
    centre = sigma
    pdf_levels = sigma
    call get(c, 'solids%E', E(1), E(2))
    call get(c, 'solids%nu', nu(1), nu(2))
    call get(c, 'solids%R', R(1), R(2))
    call get(c, 'surface%hurst', hurst)
    call get(c, 'surface%L_lambda_s', L_lambda_s)
    call get(c, 'indentation%start', start)
    call get(c, 'indentation%stop', stop)
    n = 2048
    seed = 1
    plateau = .false.
    title = ''
  end subroutine

  subroutine get(c, key, first, second)
    type(rsc_case), intent(in) :: c
    character(*), intent(in) :: key
    real(dp), intent(out) :: first
    real(dp), intent(out), optional :: second
    character(:), allocatable :: text
    text = c%get(key)
    read (text, *) first
    if (present(second)) read (text, *) first, second
  end subroutine

  ! Where the runtime has read nothing, NaN stands: rsc's own default is there, or nothing.
  subroutine same_reals(c, key, values, text)
    type(rsc_case), intent(inout) :: c
    character(*), intent(in) :: key, text
    real(dp), intent(in) :: values(:)
    real(dp) :: theirs(size(values))
    character(:), allocatable :: got
    integer :: ios
    got = c%get(key)
    theirs = ieee_value(theirs, ieee_quiet_nan)
    got = got // ' /'
    read (got, *, iostat=ios) theirs
    if (any(transfer(theirs, [0_c_int64_t]) /= transfer(values, [0_c_int64_t]) .and. &
            .not. ieee_is_nan(values))) call told(key, text)
  end subroutine
end program
