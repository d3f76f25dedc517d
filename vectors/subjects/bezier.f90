! An evaluator to be judged: evalcts vectors emit | bezier | evalcts vectors check. De Casteljau's construction in
! double precision; it leaves normals out. C's strtod reads the hexadecimal numbers.
program bezier
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_null_char, c_ptr
  implicit none
  interface
    function strtod(text, rest) bind(c) result(x)
      import :: c_double, c_ptr
      type(c_ptr), value :: text
      type(c_ptr), intent(out) :: rest
      real(c_double) :: x
    end function
  end interface
  character(len=2**18), target :: line
  character(len=16) :: kind
  character(len=64) :: id, precision
  real(c_double) :: points(4, 0:63, 0:63), u1, u2, v1, v2, u, v
  type(c_ptr) :: rest
  integer :: status, k, uorder, vorder, i, j, c
  logical :: two, is_grid

  do
    read (*, '(a)', iostat=status) line
    if (status /= 0) exit
    read (line, *) kind, id, precision
    if (index(kind, 'normal') > 0) then
      print '(2a)', trim(id), ' skip'
      cycle
    end if
    two = index(kind, '2') > 0
    is_grid = index(kind, 'grid') == 1
    ! The numbers begin behind the three words.
    i = len_trim(kind) + len_trim(id) + len_trim(precision) + 3
    line(len_trim(line) + 1:len_trim(line) + 1) = c_null_char
    rest = c_loc(line(i:i))
    k = int(number())
    uorder = int(number())
    vorder = 1; if (two) vorder = int(number())
    u1 = number()
    u2 = number()
    v1 = 0; if (two) v1 = number()
    v2 = 1; if (two) v2 = number()
    u = coordinate()
    v = 0; if (two) v = coordinate()
    do i = 0, uorder - 1
      do j = 0, vorder - 1
        points(:k, i, j) = [(number(), c=1, k)]
      end do
      do j = vorder - 1, 1, -1
        points(:k, i, :j - 1) = (v2 - v) / (v2 - v1) * points(:k, i, :j - 1) + (v - v1) / (v2 - v1) * points(:k, i, 1:j)
      end do
    end do
    do i = uorder - 1, 1, -1
      points(:k, :i - 1, 0) = (u2 - u) / (u2 - u1) * points(:k, :i - 1, 0) + (u - u1) / (u2 - u1) * points(:k, 1:i, 0)
    end do
    print '(a, *(1x, es25.17e3))', trim(id), points(:k, 0, 0)
  end do

contains
  real(c_double) function number()
    type(c_ptr) :: at
    at = rest
    number = strtod(at, rest)
  end function

  ! The argument, or the point of a grid.
  real(c_double) function coordinate() result(x)
    real(c_double) :: first, last, place
    x = number()
    if (.not. is_grid) return
    first = number()
    last = number()
    place = number()
    x = merge(last, place * ((last - first) / x) + first, place == x)
  end function
end program
