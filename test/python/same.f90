! Reads a case from a file and levels from another, and prints what the Fortran module finds, bit by bit: asperities, then separation,
! force, area, stiffness and number of contacts of each level.
program same
  use rsc
  use, intrinsic :: iso_c_binding, only: dp => c_double, int64 => c_int64_t
  implicit none
  type(rsc_case) :: options
  type(rsc_asperities) :: asperities
  type(rsc_contact) :: contact
  character(4096) :: path
  character(16) :: how
  character(:), allocatable :: text
  integer :: unit, length, status
  real(dp) :: value
  call get_command_argument(1, path)
  open (newunit=unit, file=trim(path), access='stream', status='old')
  inquire (unit, size=length)
  allocate (character(length) :: text)
  read (unit) text
  close (unit)
  call options%read(text)
  call asperities%make(options)
  call contact%create_from_case(asperities, options)
  print '(i0)', asperities%count()
  call get_command_argument(2, path)
  open (newunit=unit, file=trim(path), status='old')
  do
    read (unit, *, iostat=status) how, value
    if (status /= 0) exit
    if (how == 'press') then
      call contact%press(value)
    else
      call contact%indent(value)
    end if
    print '(4(z16.16,1x),i0)', bits(contact%separation()), bits(contact%force()), bits(contact%area()), &
      bits(contact%stiffness()), contact%contacts()
  end do
contains
  integer(int64) function bits(x)
    real(dp), intent(in) :: x
    bits = transfer(x, bits)
  end function
end program
