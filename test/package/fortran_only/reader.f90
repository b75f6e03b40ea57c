! Reads a result file.
program reader
  use rsc_results
  implicit none
  type(rsc_result) :: r
  character(200) :: file, errmsg
  integer :: stat
  call get_command_argument(1, file)
  call rsc_read_result(file, r, stat, errmsg)
  if (stat /= 0) error stop 'no result'
  print *, r%steps(), r%force(:, 1)
end program
