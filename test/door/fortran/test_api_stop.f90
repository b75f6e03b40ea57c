! A failure without stat stops the program with its message.
program test_api_stop
  use rsc
  implicit none
  type(rsc_case) :: options
  call options%set('surface%simga', 1)
  print '(a)', 'went on after a failure'
end program
