! What calls.f90 and calls77.f90 share, as calls.cpp has it: the numbers they give, and the words in which they print what they get (scene,
! what it is, its values, reals bit by bit).
module calls_common
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int64_t
  implicit none
  private
  public :: put, scene, noise, points, oblong_map
  interface put
    procedure put_real, put_reals, put_integer, put_integers, put_text
  end interface
  character(16) :: scene

contains

  real(dp) function noise(k, s)
    integer, intent(in) :: k, s
    noise = mod(k * k * s + 29 * k + 7 * s, 61) / 64.0_dp
  end function

  ! Irregular asperities, none like another.
  subroutine points(x, y, z, radius)
    real(dp), dimension(35), intent(out) :: x, y, z, radius
    integer :: k
    do k = 1, 35
      x(k) = -0.25_dp + 0.25_dp * mod(k - 1, 5) + noise(k, 1) / 8
      y(k) = 0.5_dp + 0.375_dp * ((k - 1) / 5) + noise(k, 2) / 8
      z(k) = noise(k, 3) / 16
      radius(k) = 0.25_dp + noise(k, 4) / 4
    end do
  end subroutine

  function oblong_map() result(z)
    real(dp) :: z(9, 7)
    integer :: i, j
    do j = 1, 7
      do i = 1, 9
        z(i, j) = noise(i + 9 * j, 9) / 8 + (i * i - 2 * i * j) / 256.0_dp + j / 64.0_dp
      end do
    end do
  end function

  subroutine put_real(what, v)
    character(*), intent(in) :: what
    real(dp), intent(in) :: v
    call put_reals(what, [v])
  end subroutine
  subroutine put_reals(what, v)
    character(*), intent(in) :: what
    real(dp), intent(in) :: v(:)
    print '(a,1x,a,*(1x,z16.16))', trim(scene), what, transfer(v, [0_c_int64_t])
  end subroutine
  subroutine put_integer(what, v)
    character(*), intent(in) :: what
    integer, intent(in) :: v
    call put_integers(what, [v])
  end subroutine
  subroutine put_integers(what, v)
    character(*), intent(in) :: what
    integer, intent(in) :: v(:)
    print '(a,1x,a,*(1x,i0))', trim(scene), what, v
  end subroutine
  subroutine put_text(what, v)
    character(*), intent(in) :: what, v
    integer :: k
    character(len(v)) :: line
    line = v
    do k = 1, len(v)
      if (line(k:k) == new_line('a')) line(k:k) = '|'
    end do
    print '(a,1x,a,1x,a)', trim(scene), what, trim(line)
  end subroutine
end module
