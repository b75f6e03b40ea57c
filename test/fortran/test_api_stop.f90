! What stops the program with its message: a failure without stat, and arrays of objects that cannot be assigned. Run with the way to try.
program test_api_stop
  use rsc
  implicit none
  type(rsc_case) :: options
  type(rsc_case), allocatable :: list(:), more(:)
  character(20) :: way
  call get_command_argument(1, way)
  allocate (list(2))
  select case (way)
  case ('sigma')
    call options%set('surface%simga', 1)
  case ('allocated')
    more = list
  case ('size')
    list = [list, options]
  end select
  print '(a)', 'went on after a failure'
end program
