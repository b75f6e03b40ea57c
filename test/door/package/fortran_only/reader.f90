! Reads a result file; uses netcdf-fortran itself, too, whose module folder comes with rsc::results.
program reader
  use rsc_results
  use netcdf, only: nf90_get_att, nf90_global, nf90_noerr
  implicit none
  type(rsc_result) :: r
  real(real64), allocatable :: force(:,:)
  character(200) :: file
  integer :: seed
  call get_command_argument(1, file)
  call r%open(file)
  call r%get('force', force)
  if (nf90_get_att(r%id, nf90_global, 'seed', seed) /= nf90_noerr) error stop 'no seed'
  print *, size(force, 1), force(:, 1)
  call r%close()
end program
