!> The law of an interface in Fortran 2008: reads the text that output/export/law.py writes with
!> --text, and evaluates its columns. This file is all that it needs.
!>
!>     use rsc_law
!>     type(law) :: interface
!>     call interface%read('seal.law')
!>     call interface%evaluate('pressure', 1, gap, pressure, slope, where)
!>
!> evaluate(name, against, x, value, slope, where): the column `name` at values x of the column
!> `against`, 1 or 2; slopes with respect to x; where is -1 below the rows, 0 within, 1 beyond and 2
!> without a value (then value and slope are NaN). x and the results have the same size; slope and
!> where are optional. The last arguments stat and errmsg, both optional, receive the status and its
!> message; without stat a failure is an error stop.
!>
!> The form of the text, and how it is interpolated, is described in modules/rsc/law.py. After
!> reading, a law does not change: any threads may evaluate it.
!>
!> In the style of FORTRAN 77, with the law in an array W of the caller:
!>
!>     CALL LAWRED(FILE, NCOL, NAMES, NW, W, NEED, IERR)
!>     CALL LAWVAL(W, K, IAGAIN, N, X, Y, DY, IWHERE, IERR)
!>
!> LAWRED reads the NCOL columns NAMES into W, of NW numbers; NEED is the size that it needs. LAWVAL
!> evaluates the K-th of them against column IAGAIN (1 or 2) of the file. IERR is the status.
module rsc_law
  use, intrinsic :: iso_fortran_env, only: error_unit, real64
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
  implicit none
  private
  public :: law, law_message, evaluate_packed, pack_law
  public :: law_success, law_file, law_form, law_column, law_argument, law_memory

  integer, parameter :: law_success = 0
  integer, parameter :: law_file = 1      !< the file cannot be read
  integer, parameter :: law_form = 2      !< it is no text of a law; component line: where, or 0
  integer, parameter :: law_column = 3    !< no such column, or not against this one
  integer, parameter :: law_argument = 4  !< some argument has no value
  integer, parameter :: law_memory = 5    !< out of memory; LAWRED: W is too small
  integer, parameter :: word_length = 48

  !> What the coefficients of a piece are of: the value, its logarithm; beyond the rows also
  !> c0 exp(c1/c0 t) as the value, or as its logarithm.
  integer, parameter :: of_value = 0, of_logarithm = 1, decay = 2, log_decay = 3

  type :: law
    character(word_length), allocatable :: name(:), unit(:)
    real(real64), allocatable :: values(:, :)  !< (column, row)
    integer :: line = 0                        !< of the file, where it is wrong
    character(word_length), allocatable, private :: word(:, :)
    real(real64), allocatable, private :: packed(:)
  contains
    procedure :: read => read_law
    procedure :: column
    procedure :: evaluate
  end type

contains
  pure function law_message(status) result(text)
    integer, intent(in) :: status
    character(:), allocatable :: text
    select case (status)
    case (law_success)
      text = 'success'
    case (law_file)
      text = 'the file cannot be read'
    case (law_form)
      text = 'the file is not the text of a law of rsc'
    case (law_column)
      text = 'no such column, or not against this abscissa'
    case (law_argument)
      text = 'the law has no value at some argument'
    case default
      text = 'not enough memory'
    end select
  end function

  !> The number of a column, 0 if there is none of this name.
  pure integer function column(self, name)
    class(law), intent(in) :: self
    character(*), intent(in) :: name
    do column = size(self%name), 1, -1
      if (self%name(column) == name) return
    end do
  end function

  subroutine read_law(self, file, stat, errmsg)
    class(law), intent(inout) :: self
    character(*), intent(in) :: file
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: status, k
    character(24) :: line
    call read_text(self, trim(file), status)
    if (status == law_success) call pack_law(self, [(k, k=1, size(self%name))], self%packed, status)
    line = ''
    if (self%line > 0) write (line, '(a, i0)') ', line ', self%line
    call finish(trim(file)//trim(line), status, stat, errmsg)
  end subroutine

  subroutine evaluate(self, name, against, x, value, slope, where, stat, errmsg)
    class(law), intent(in) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: against
    real(real64), intent(in) :: x(:)
    real(real64), intent(out) :: value(:)
    real(real64), intent(out), optional :: slope(:)
    integer, intent(out), optional :: where(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: i, start, status, w, n
    real(real64) :: d
    status = law_column
    n = size(x)
    start = 0
    if (allocated(self%packed)) start = curve_start(self%packed, self%column(name), against)
    if (start > 0) status = law_success
    if (present(slope)) n = min(n, size(slope))
    if (present(where)) n = min(n, size(where))
    if (min(n, size(value)) < size(x)) status = law_memory
    if (status == law_success) then
      do i = 1, size(x)
        call evaluate_curve(self%packed(start:), x(i), value(i), d, w)
        if (w == 2) status = law_argument
        if (present(slope)) slope(i) = d
        if (present(where)) where(i) = w
      end do
    end if
    call finish(name, status, stat, errmsg)
  end subroutine

  subroutine finish(what, status, stat, errmsg)
    character(*), intent(in) :: what
    integer, intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status /= law_success .and. present(errmsg)) errmsg = what//': '//law_message(status)
    if (present(stat)) then
      stat = status
    else if (status /= law_success) then
      write (error_unit, '(3a)') what, ': ', law_message(status)
      error stop 'rsc_law: a call without stat failed'
    end if
  end subroutine

  !> Columns and rows of the text.
  subroutine read_text(self, file, status)
    class(law), intent(inout) :: self
    character(*), intent(in) :: file
    integer, intent(out) :: status
    integer, parameter :: longest = 4096
    character(longest) :: line
    integer :: unit, ios, columns, rows, pass
    self%line = 0
    status = law_file
    open (newunit=unit, file=file, status='old', action='read', iostat=ios)
    if (ios /= 0) return
    do pass = 1, 2  ! counts columns and rows, then reads them
      columns = 0
      rows = 0
      self%line = 0
      rewind (unit)
      do
        read (unit, '(a)', iostat=ios) line
        if (ios /= 0) exit
        self%line = self%line + 1
        call take_line(self, line, pass == 2, columns, rows, status)
        if (status /= law_success) exit
      end do
      if (self%line == 0) status = law_form
      if (status /= law_success) exit
      if (pass == 2) exit
      if (columns < 2 .or. rows < 2) then
        status = law_form
        self%line = 0
        exit
      end if
      call make_room(self, columns, rows)
    end do
    close (unit)
    if (status == law_success) self%line = 0
  end subroutine

  subroutine make_room(self, columns, rows)
    class(law), intent(inout) :: self
    integer, intent(in) :: columns, rows
    if (allocated(self%name)) deallocate (self%name, self%unit, self%word, self%values)
    allocate (self%name(columns), self%unit(columns), self%word(2, columns))
    allocate (self%values(columns, rows))
  end subroutine

  !> A line of the text: a column, a row, or neither. Stored if `keep`.
  subroutine take_line(self, line, keep, columns, rows, status)
    class(law), intent(inout) :: self
    character(*), intent(in) :: line
    logical, intent(in) :: keep
    integer, intent(inout) :: columns, rows
    integer, intent(out) :: status
    character(len(line)) :: rest
    character(word_length) :: word(7)
    integer :: k, n, colon
    real(real64) :: x
    status = law_form
    rest = line
    if (len_trim(line) == len(line)) return
    colon = max(index(line, ':'), 1)
    if (self%line == 1) then
      call split(rest, word, n)
      if (n == 4 .and. all(word(:4) == [character(word_length) :: '#', 'rsc', 'law', '1'])) &
        status = law_success
      return
    end if
    call next_word(rest, word(1))
    if (word(1) == '' .or. word(1)(1:1) == '#') then
      status = law_success
      call next_word(rest, word(2))
      if (word(1) /= '#' .or. word(2) /= 'column') return
      rest = line(:colon - 1)
      call split(rest, word, n)
      columns = columns + 1
      if (n /= 6 .or. rows > 0) status = law_form
      if (.not. keep) return
      self%name(columns) = word(3)
      self%unit(columns) = word(4)
      self%word(:, columns) = word(5:6)
      return
    end if
    rows = rows + 1
    if (columns == 0) return
    do k = 1, columns
      if (word(1) == '' .or. verify(trim(word(1)), '0123456789+-.eE') > 0) return
      read (word(1), *, iostat=n) x
      if (n /= 0) return
      if (.not. ieee_is_finite(x)) return
      if (keep) self%values(k, rows) = x
      call next_word(rest, word(1))
    end do
    if (word(1) == '') status = law_success
  end subroutine

  subroutine split(text, word, n)
    character(*), intent(inout) :: text
    character(*), intent(out) :: word(:)
    integer, intent(out) :: n
    do n = 0, size(word) - 1
      call next_word(text, word(n + 1))
      if (word(n + 1) == '') return
    end do
    n = size(word)
  end subroutine

  !> Takes the first word off the text; blank if there is none.
  subroutine next_word(text, word)
    character(*), intent(inout) :: text
    character(*), intent(out) :: word
    character(*), parameter :: blanks = ' '//achar(9)//achar(10)//achar(13)
    integer :: first, length
    first = verify(text, blanks)
    word = ''
    if (first == 0) return
    length = scan(text(first:), blanks) - 1
    if (length < 0) length = len(text) - first + 1
    word = text(first:first + length - 1)
    text = text(first + length:)
  end subroutine

  !> The curves of these columns against the first two of the file, one after the other: their
  !> number, where each begins (0: none), and of each the number n of nodes, whether the value and
  !> the abscissa are logarithms, the nodes, and the form and four coefficients of the
  !> pieces before, between and after the nodes.
  subroutine pack_law(self, wanted, packed, status)
    class(law), intent(inout) :: self
    integer, intent(in) :: wanted(:)
    real(real64), allocatable, intent(out) :: packed(:)
    integer, intent(out) :: status
    integer :: k, axis, next
    status = law_column
    if (any(wanted == 0)) return
    allocate (packed(1 + 2*size(wanted)*(6*size(self%values, 2) + 9)), source=0.0_real64)
    packed(1) = size(wanted)
    next = 2 + 2*size(wanted)
    do k = 1, size(wanted)
      do axis = 1, 2
        if (self%word(axis, wanted(k)) == '-' .or. wanted(k) == axis) cycle
        packed(2*k + axis - 1) = next
        call make_curve(self, wanted(k), axis, packed(next:), next, status)
        if (status /= law_success) return
      end do
    end do
    packed = packed(:next - 1)
    status = law_success
  end subroutine

  subroutine make_curve(self, k, axis, curve, next, status)
    class(law), intent(in) :: self
    integer, intent(in) :: k, axis
    real(real64), intent(inout) :: curve(:)
    integer, intent(inout) :: next
    integer, intent(out) :: status
    character(word_length) :: word
    logical :: log_value, log_x, to_one
    real(real64), dimension(size(self%values, 2)) :: x, y
    integer :: n
    status = law_form
    word = self%word(axis, k)
    n = index(word, '-to-1')
    to_one = n > 0 .and. n == len_trim(word) - 4
    if (to_one) word(n:) = ''
    log_value = word == 'power' .or. word == 'exponential'
    log_x = word == 'power' .or. word == 'logarithmic'
    if (.not. (log_value .or. log_x .or. word == 'linear')) return
    x = self%values(axis, :)
    y = self%values(k, :)
    n = size(x)
    if (x(1) > x(n)) then
      x = x(n:1:-1)
      y = y(n:1:-1)
    end if
    if (log_x) then
      n = count(x > 0)
      y(:n) = pack(y, x > 0)
      x(:n) = log(pack(x, x > 0))
    end if
    if (n < 2) return
    if (.not. all(x(2:n) > x(:n - 1))) return
    if (log_value .and. any(y(:n) < 0)) return
    curve(1:3) = [real(n, real64), merge(1.0_real64, 0.0_real64, log_value), &
                  merge(1.0_real64, 0.0_real64, log_x)]
    curve(4:3 + n) = x(:n)
    call make_pieces(x(:n), y(:n), log_value, to_one, curve(4 + n:8 + 6*n))
    next = next + 8 + 6*n
    status = law_success
  end subroutine

  subroutine make_pieces(x, y, log_value, to_one, piece)
    real(real64), intent(in) :: x(:), y(:)
    logical, intent(in) :: log_value, to_one
    real(real64), intent(out) :: piece(0:4, 0:*)
    real(real64), dimension(size(x)) :: raised, slope, unit
    logical :: positive(size(x)), logs
    real(real64) :: h, a, b, m, e, d
    integer :: n, k, i, side
    n = size(x)
    positive = .true.
    raised = y
    unit = 1
    if (log_value) then
      positive = y > 0
      raised = log(merge(y, 1.0_real64, positive))
      unit = y
    end if
    do i = 1, n
      slope(i) = slope_at(x, raised, positive, i)
    end do
    do k = 1, n - 1
      logs = log_value .and. positive(k) .and. positive(k + 1)
      a = merge(raised(k), y(k), logs)
      b = merge(raised(k + 1), y(k + 1), logs)
      m = slope(k)*merge(1.0_real64, unit(k), logs)
      e = slope(k + 1)*merge(1.0_real64, unit(k + 1), logs)
      h = x(k + 1) - x(k)
      d = (b - a)/h
      piece(:, k) = [real(merge(of_logarithm, of_value, logs), real64), a, m, &
                     (3*d - 2*m - e)/h, (m + e - 2*d)/(h*h)]
    end do
    do side = -1, 1, 2
      i = merge(1, n, side < 0)
      k = merge(0, n, side < 0)
      piece(0:4, k) = 0
      if (.not. positive(i)) cycle
      piece(1, k) = raised(i)
      piece(2, k) = slope(i)
      piece(0, k) = merge(of_logarithm, of_value, log_value)
      if ((to_one .or. .not. log_value) .and. raised(i)*slope(i)*side < 0) &
        piece(0, k) = piece(0, k) + 2
    end do
  end subroutine

  !> Slope over the interval k in the coordinates of its end `of`, where the column is not 0.
  pure real(real64) function secant(x, raised, positive, k, of)
    real(real64), intent(in) :: x(:), raised(:)
    logical, intent(in) :: positive(:)
    integer, intent(in) :: k, of
    secant = merge(-1.0_real64, 1.0_real64, of == k)
    if (positive(k) .and. positive(k + 1)) secant = raised(k + 1) - raised(k)
    secant = secant/(x(k + 1) - x(k))
  end function

  !> That of a parabola through three nodes, limited so that each cubic is monotonic.
  pure real(real64) function slope_at(x, raised, positive, i) result(m)
    real(real64), intent(in) :: x(:), raised(:)
    logical, intent(in) :: positive(:)
    integer, intent(in) :: i
    integer :: n, own, other, next
    real(real64) :: d, e, before, after, most
    n = size(x)
    m = 0
    if (.not. positive(i)) return
    own = max(i - 1, 1)
    d = secant(x, raised, positive, own, i)
    if (i > 1 .and. i < n) then
      e = secant(x, raised, positive, i, i)
      before = x(i) - x(i - 1)
      after = x(i + 1) - x(i)
      m = (after*d + before*e)/(before + after)
      most = merge(3*min(abs(d), abs(e)), 0.0_real64, d*e > 0)
    else
      m = d
      next = merge(2, n - 1, i == 1)
      other = merge(2, n - 2, i == 1)
      if (n > 2) then
        if (positive(next)) then
          before = x(own + 1) - x(own)
          after = x(other + 1) - x(other)
          m = d + (d - secant(x, raised, positive, other, next))*before/(before + after)
        end if
      end if
      most = merge(3*abs(d), 0.0_real64, m*d > 0)
    end if
    m = max(-most, min(most, m))
  end function

  !> Where the curve of the k-th packed column begins, 0 if there is none.
  pure integer function curve_start(packed, k, against)
    real(real64), intent(in) :: packed(*)
    integer, intent(in) :: k, against
    curve_start = 0
    if (k < 1 .or. k > nint(packed(1)) .or. against < 1 .or. against > 2) return
    curve_start = nint(packed(2*k + against - 1))
  end function

  !> As LAWVAL.
  subroutine evaluate_packed(packed, k, against, n, x, value, slope, where, status)
    integer, intent(in) :: k, against, n
    real(real64), intent(in) :: packed(*), x(n)
    real(real64), intent(out) :: value(n), slope(n)
    integer, intent(out) :: where(n), status
    integer :: i, start
    status = law_column
    start = curve_start(packed, k, against)
    if (start == 0) return
    status = law_success
    do i = 1, n
      call evaluate_curve(packed(start), x(i), value(i), slope(i), where(i))
      if (where(i) == 2) status = law_argument
    end do
  end subroutine

  pure subroutine evaluate_curve(curve, x, value, slope, where)
    real(real64), intent(in) :: curve(*), x
    real(real64), intent(out) :: value, slope
    integer, intent(out) :: where
    integer :: n, low, high, middle, form, p
    real(real64) :: at, t, factor
    logical :: log_x
    n = nint(curve(1))
    log_x = curve(3) > 0
    at = x
    if (log_x .and. x <= 0) then
      value = limit(curve(4 + n:6 + n))
      slope = 0
      where = -1
    else
      if (log_x) at = log(x)
      low = 0
      high = n
      do while (low < high)  ! the number of nodes at or below it
        middle = (low + high)/2
        if (curve(4 + middle) <= at) then
          low = middle + 1
        else
          high = middle
        end if
      end do
      if (at == curve(3 + n)) low = low - 1
      where = merge(-1, merge(1, 0, low == n), low == 0)
      t = at - curve(3 + max(low, 1))
      p = 4 + n + 5*low
      form = nint(curve(p))
      if (form < decay) then
        value = ((curve(p + 4)*t + curve(p + 3))*t + curve(p + 2))*t + curve(p + 1)
        slope = (3*curve(p + 4)*t + 2*curve(p + 3))*t + curve(p + 2)
      else
        factor = exp(curve(p + 2)/curve(p + 1)*t)
        value = curve(p + 1)*factor
        slope = curve(p + 2)*factor
      end if
      if (form == of_logarithm .or. form == log_decay) then
        value = exp(value)
        slope = slope*value
      end if
      if (log_x) slope = slope/x
    end if
    if (ieee_is_finite(value) .and. ieee_is_finite(slope)) return
    value = ieee_value(value, ieee_quiet_nan)
    slope = value
    where = 2
  end subroutine

  !> Of an abscissa of 0 or below, where its logarithm does not exist; NaN: there is no limit.
  pure real(real64) function limit(first)
    real(real64), intent(in) :: first(3)
    integer :: form
    form = nint(first(1))
    limit = merge(1, 0, form == log_decay)
    if (first(3) == 0) then
      limit = first(2)
      if (form == of_logarithm) limit = exp(first(2))
    else if (form == of_value .or. (form == of_logarithm .and. first(3) < 0)) then
      limit = ieee_value(limit, ieee_quiet_nan)
    end if
  end function
end module

subroutine lawred(file, ncol, names, nw, w, need, ierr)
  use rsc_law, only: law, pack_law, law_success, law_memory
  implicit none
  character(*) :: file, names(*)
  integer :: ncol, nw, need, ierr, k
  double precision :: w(*)
  double precision, allocatable :: packed(:)
  type(law) :: table
  need = 0
  call table%read(file, ierr)
  if (ierr == law_success) call pack_law(table, [(table%column(names(k)), k=1, ncol)], packed, ierr)
  if (ierr /= law_success) return
  need = size(packed)
  ierr = law_memory
  if (need > nw) return
  w(:need) = packed
  ierr = law_success
end subroutine

subroutine lawval(w, k, iagain, n, x, y, dy, iwhere, ierr)
  use rsc_law, only: evaluate_packed
  implicit none
  integer :: k, iagain, n, iwhere(*), ierr
  double precision :: w(*), x(*), y(*), dy(*)
  call evaluate_packed(w, k, iagain, n, x, y, dy, iwhere, ierr)
end subroutine
