! Reads the files 1.nml, 2.nml, ... of a folder as namelist input, with the Fortran runtime itself, and prints what it got from
! each group: the status of the read (0, -1 not found or not ended, 1 refused) and the bits of every value. The other side of
! namelist_differential.cpp, which writes namelist_groups.inc: the groups with their keys, by the registry.
program namelist_reader
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  implicit none
  integer(int64), parameter :: unset_bits = int(z'7FF8DEADBEEF0001', int64)
  integer, parameter :: unit_in = 10
  real(real64) :: unset
  character(len=4096) :: folder, word
  integer :: i, count

  unset = transfer(unset_bits, unset)
  call get_command_argument(1, folder)
  call get_command_argument(2, word)
  read (word, *) count
  do i = 1, count
    write (word, '(a,"/",i0,".nml")') trim(folder), i
    open (unit_in, file=trim(word), status='old', action='read')
    print '(a,1x,i0)', 'case', i
    call read_groups()
    close (unit_in)
  end do

contains

  subroutine status(group, ios)
    character(len=*), intent(in) :: group
    integer, intent(in) :: ios
    print '(a,1x,i0)', 'status '//group, sign(min(abs(ios), 1), ios)
    rewind (unit_in)
  end subroutine

  subroutine put_real(name, x, element)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: x
    integer, intent(in), optional :: element
    character(len=16) :: value, index
    index = ''
    if (present(element)) write (index, '("(",i0,")")') element
    if (transfer(x, unset_bits) == unset_bits) then
      value = 'unset'
    else if (x /= x) then
      value = 'nan'
    else
      write (value, '(z16.16)') transfer(x, unset_bits)
    end if
    print '(a)', name//trim(index)//' '//trim(value)
  end subroutine

  subroutine put_list(name, x)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: x(:)
    integer :: k, last
    last = 0
    do k = 1, size(x)
      if (transfer(x(k), unset_bits) /= unset_bits) last = k
    end do
    do k = 1, last
      call put_real(name, x(k), k)
    end do
  end subroutine

  subroutine put_integer(name, n)
    character(len=*), intent(in) :: name
    integer(int64), intent(in) :: n
    print '(a,1x,i0)', name, n
  end subroutine

  subroutine put_logical(name, value)
    character(len=*), intent(in) :: name
    logical, intent(in) :: value
    print '(a,1x,l1)', name, value
  end subroutine

  subroutine put_text(name, text)
    character(len=*), intent(in) :: name, text
    integer :: k
    write (*, '(a)', advance='no') name//' '
    do k = 1, len_trim(text)
      write (*, '(z2.2)', advance='no') iachar(text(k:k))
    end do
    print '(a)', '.'
  end subroutine

  include 'namelist_groups.inc'

end program namelist_reader
