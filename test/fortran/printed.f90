! The words in which calls.f90 and calls77.f90 print what they get, as calls.cpp does: scene, what it is, its values (reals bit by bit).
module printed
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int64_t
  implicit none
  private
  public :: put, scene
  interface put
    procedure put_real, put_reals, put_integer, put_integers, put_text
  end interface
  character(16) :: scene

contains

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
