! Calls the user subroutine as a finite-element code would: a spring of stiffness k per area between the interface and a moved end, solved
! by Newton's method with the slope that uinter gives. Reads from standard input: the number of properties, the properties, k, the number
! of displacements, the displacements; prints for each: overclosure, pressure, slope, Newton iterations.
program uinter_main
  implicit none
  integer, parameter :: dp = kind(1.0d0)
  integer :: nprops, n, i, it
  real(dp) :: k, u, c, step, residual
  real(dp), allocatable :: props(:), displacement(:)
  real(dp) :: stress(3), ddsddr(3, 3)
  integer :: lopenclose
  read *, nprops
  allocate (props(nprops))
  read *, props
  read *, k, n
  allocate (displacement(n))
  read *, displacement
  c = 0
  do i = 1, n
    u = displacement(i)
    do it = 1, 200
      call law(c)
      residual = stress(1) - k * (u - c)
      if (abs(residual) <= 1.0e-10_dp * (abs(k * u) + tiny(k))) exit
      step = -residual / (ddsddr(1, 1) + k)
      c = c + step
    end do
    if ((stress(1) > 0) .neqv. (lopenclose == 1)) error stop 'lopenclose does not say whether there is contact'
    if (any(abs(stress(2:)) > 0)) error stop 'tangential stress without friction'
    print '(3(es24.16,1x),i0)', c, stress(1), ddsddr(1, 1), it
  end do

contains

  subroutine law(overclosure)
    real(dp), intent(in) :: overclosure
    real(dp) :: matrix(3, 3), flux(2), two(2, 2), d3(3, 2), d2(2, 3), statev(1), energy(5), pnewdt, rdisp(3), drdisp(3), &
                predef(2, 1), time(2), coords(3), three(3, 3), rotation(2, 2)
    character(80) :: name
    matrix = 0; flux = 0; two = 0; d3 = 0; d2 = 0; statev = 0; energy = 0; pnewdt = 1
    drdisp = 0; predef = 0; time = 0; coords = 0; three = 0; rotation = 0
    rdisp = [overclosure, 0.0_dp, 0.0_dp]
    name = 'ROUGH'
    call uinter(stress, ddsddr, matrix, matrix, flux, two, d3, d2, statev, energy(1), energy(2), energy(3), energy(4), &
                energy(5), pnewdt, rdisp, drdisp, flux, flux, predef, predef, time, 1.0_dp, 1.0_dp, name, name, name, props, &
                coords, three, rotation, 1.0_dp, 1.0_dp, 1, 3, 1, 1, nprops, 3, 1, 1, 1, 0, lopenclose, 0, 0, 0)
  end subroutine
end program
