! As law_values.c, by the type and by the subroutines in the style of FORTRAN 77, which give the
! same bits.
program law_values
  use rsc_law
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  type(law) :: table
  character(500) :: word(4), errmsg
  real(real64), allocatable :: x(:), y(:), slope(:), y77(:), slope77(:), w(:)
  integer, allocatable :: where(:), where77(:)
  integer :: i, n, against, status, status77, need, line
  n = 0
  do i = 1, command_argument_count()
    call get_command_argument(i, word(i))
  end do
  if (command_argument_count() > 3) read (word(4), *) n
  if (command_argument_count() > 3) read (word(3), *) against
  allocate (x(n), y(n), slope(n), y77(n), slope77(n), where(n), where77(n))
  if (n > 0) read (*, *) x
  call table%read(word(1), status, errmsg)
  line = table%line
  if (status == law_success .and. n > 0) then
    call table%evaluate(trim(word(2)), against, x, y, slope, where, status, errmsg)
    allocate (w(0))
    call lawred(word(1), 1, word(2), 0, w, need, status77)
    deallocate (w)
    allocate (w(need))
    if (status77 == law_memory) call lawred(word(1), 1, word(2), need, w, need, status77)
    if (status77 == law_success) call lawval(w, 1, against, n, x, y77, slope77, where77, status77)
    if (status77 /= status) error stop 'the status of LAWRED or LAWVAL differs'
    if (status == law_success) then
      if (any(y77 /= y .or. slope77 /= slope .or. where77 /= where)) error stop 'LAWVAL differs'
    end if
  end if
  print '(i0, 1x, i0)', status, line
  if (status /= law_success .and. status /= law_argument) n = 0
  do i = 1, n
    print '(es25.17e3, 1x, es25.17e3, 1x, i0)', y(i), slope(i), where(i)
  end do
end program
