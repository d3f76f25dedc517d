! Tests every routine of the binding against the rules of the GL. The main program captures the positions of vertices between
! capbeg and capend. In failures, the macros print the call.
#define ERROR(CODE, COMMAND) call COMMAND; call expect("COMMAND", CODE)
#define ERROR_IN_PRIMITIVE(COMMAND) call fglBegin(GL_POINTS); call COMMAND; call fglEnd; \
  call expect("COMMAND in a primitive", GL_INVALID_OPERATION)
#define CURRENT(NAME, COMMAND, VALUES) c = 9.; call COMMAND; call fglGetFloatv(NAME, c); \
  call check("COMMAND", all(c == VALUES))
#define HAS(COMMAND, VALUES) call COMMAND; call check("COMMAND", has_map(VALUES))
module positions
  use fgl
  implicit none
  integer :: n
  real(4) :: pos(3, 1000)
  common /captur/ n, pos
contains
  ! Returns true if captured vertex i is at (x, y, z).
  logical function at(i, x, y, z)
    integer, intent(in) :: i
    real(4), intent(in) :: x, y, z
    at = i <= n
    if (at) at = all(abs(pos(:, i) - (/x, y, z/)) < 1e-5)
  end function

  ! Returns true if MAP1_VERTEX_3 has these two points.
  logical function has_map(values)
    real(4), intent(in) :: values(6)
    real(4) :: v(6)
    v = -1.
    call fglGetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, v)
    has_map = all(v == values)
  end function
end module

subroutine calls
  call curves
  call surfaces
  call grids
  call arrays
  call own_vertices
  call switches
  call map_errors
  call query_errors
  call mesh_errors
end subroutine

! Map1, EvalCoord1 in its four forms. Order 3, so that the curve is (2u - 1, 2u(1 - u), 0), over (0,1) and over (1,3).
subroutine curves
  use positions
  implicit none
  real(4) :: p(3, 3), q(5, 3), u(1), v4(9)
  real(8) :: p8(3, 3), u8(1), v8(9), ends(2)
  integer(4) :: vi(9), order
  p = reshape((/-1., 0., 0., 0., 1., 0., 1., 0., 0./), (/3, 3/))
  p8 = p
  q(1:3, :) = p
  q(4, :) = 7.
  q(5, :) = 9.
  u = .5
  u8 = 1d0
  call fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 3, p)
  call fglEnable(GL_MAP1_VERTEX_3)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglEvalCoord1f(0.)
  call fglEvalCoord1d(0.25d0)
  call fglEvalCoord1fv(u)
  call fglEvalCoord1dv(u8)
  call fglEvalCoord1fv(u(1))
  call fglEnd
  call capend
  call check('Map1f: five vertices', n == 5)
  call check('EvalCoord1f at 0', at(1, -1., 0., 0.))
  call check('EvalCoord1d at 1/4', at(2, -.5, .375, 0.))
  call check('EvalCoord1fv at 1/2', at(3, 0., .5, 0.))
  call check('EvalCoord1dv at 1', at(4, 1., 0., 0.))
  call check('EvalCoord1fv of an element', at(5, 0., .5, 0.))

  ! A larger stride, another domain, doubles.
  call fglMap1f(GL_MAP1_VERTEX_3, 1., 3., 5, 3, q)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglEvalCoord1f(1.5)
  call fglEnd
  call capend
  call check('Map1f, stride 5 over (1,3)', at(1, -.5, .375, 0.))
  call fglGetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, v4)
  call check('GetMapfv COEFF without what is between', all(v4 == reshape(p, (/9/))))
  call fglMap1d(GL_MAP1_VERTEX_3, -1d0, 1d0, 3, 3, p8)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglEvalCoord1d(0d0)
  call fglEnd
  call capend
  call check('Map1d over (-1,1)', n == 1 .and. at(1, 0., .5, 0.))

  ! Stored values.
  call fglGetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN, ends)
  call check('GetMapdv DOMAIN', all(ends == (/-1d0, 1d0/)))
  call fglGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, order)
  call check('GetMapiv ORDER', order == 3)
  call fglGetMapdv(GL_MAP1_VERTEX_3, GL_COEFF, v8)
  call check('GetMapdv COEFF', all(v8 == reshape(p8, (/9/))))
  call fglGetMapiv(GL_MAP1_VERTEX_3, GL_COEFF, vi)
  call check('GetMapiv COEFF', all(vi == nint(v8)))
  call expect('curves: no error', GL_NO_ERROR)
  call fglDisable(GL_MAP1_VERTEX_3)
end subroutine

! Map2, EvalCoord2 in its four forms. Of order 2 in u and 3 in v, (u, v*v, u*v): control point (i,j) is (i, [j = 2], i*j/2).
! The array is p(3, u, v), and r(3, v, u) the other way round.
subroutine surfaces
  use positions
  implicit none
  real(4) :: p(3, 2, 3), ends(4)
  real(8) :: r(3, 3, 2)
  integer(4) :: order(2), vi(18)
  integer :: i, j
  do j = 1, 3
    do i = 1, 2
      p(:, i, j) = (/real(i - 1), real((j - 1) / 2), (i - 1) * (j - 1) * .5/)
      r(:, j, i) = p(:, i, j)
    end do
  end do
  call fglEnable(GL_MAP2_VERTEX_3)
  call fglMap2f(GL_MAP2_VERTEX_3, 0., 1., 3, 2, 0., 1., 6, 3, p)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglEvalCoord2f(.25, .5)
  call fglEvalCoord2d(.5d0, .25d0)
  call fglEvalCoord2fv((/1., .5/))
  call fglEvalCoord2dv((/.5d0, 1d0/))
  call fglEnd
  call capend
  call check('Map2f: four vertices', n == 4)
  call check('EvalCoord2f', at(1, .25, .25, .125))
  call check('EvalCoord2d', at(2, .5, .0625, .125))
  call check('EvalCoord2fv', at(3, 1., .25, .5))
  call check('EvalCoord2dv', at(4, .5, 1., .5))

  call fglMap2d(GL_MAP2_VERTEX_3, 0d0, 2d0, 9, 2, -1d0, 1d0, 3, 3, r)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglEvalCoord2d(.5d0, 0d0)
  call fglEnd
  call capend
  call check('Map2d', n == 1 .and. at(1, .25, .25, .125))
  call fglGetMapfv(GL_MAP2_VERTEX_3, GL_DOMAIN, ends)
  call check('GetMapfv DOMAIN', all(ends == (/0., 2., -1., 1./)))
  call fglGetMapiv(GL_MAP2_VERTEX_3, GL_ORDER, order)
  call check('GetMapiv ORDER, u before v', all(order == (/2, 3/)))
  call fglGetMapiv(GL_MAP2_VERTEX_3, GL_COEFF, vi)
  call check('GetMapiv COEFF, v fastest', vi(1) == 0 .and. vi(8) == 1 .and. vi(10) == 1 .and. vi(17) == 1)
  call expect('surfaces: no error', GL_NO_ERROR)
  call fglDisable(GL_MAP2_VERTEX_3)
end subroutine

! MapGrid, EvalPoint, EvalMesh. The curve is (u, u, 0), the surface (u, v, uv).
subroutine grids
  use positions
  implicit none
  real(4) :: p(6) = (/0., 0., 0., 1., 1., 0./), q(12) = (/0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 1./), g4(4)
  real(8) :: g8(2)
  integer(4) :: segments(2)
  call fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, p)
  call fglMap2f(GL_MAP2_VERTEX_3, 0., 1., 3, 2, 0., 1., 6, 2, q)
  call fglEnable(GL_MAP1_VERTEX_3)
  call fglEnable(GL_MAP2_VERTEX_3)

  call fglMapGrid1f(4, 0., 1.)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglEvalPoint1(1)
  call fglEnd
  call fglEvalMesh1(GL_POINT, 2, 4)
  call capend
  call check('EvalPoint1 and EvalMesh1', n == 4 .and. at(1, .25, .25, 0.) .and. at(2, .5, .5, 0.) .and. at(4, 1., 1., 0.))
  call capbeg
  call fglEvalMesh1(GL_LINE, 0, 4)
  call capend
  call check('EvalMesh1 LINE', n >= 5 .and. at(1, 0., 0., 0.) .and. at(n, 1., 1., 0.))
  call fglMapGrid1d(2, .5d0, 1d0)
  call fglGetDoublev(GL_MAP1_GRID_DOMAIN, g8)
  call fglGetIntegerv(GL_MAP1_GRID_SEGMENTS, segments)
  call check('MapGrid1d', all(g8 == (/.5d0, 1d0/)) .and. segments(1) == 2)
  call capbeg
  call fglEvalMesh1(GL_POINT, 1, 1)
  call capend
  call check('its middle', n == 1 .and. at(1, .75, .75, 0.))

  call fglMapGrid2f(2, 0., 1., 4, 0., 1.)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglEvalPoint2(1, 3)
  call fglEnd
  call fglEvalMesh2(GL_POINT, 0, 2, 0, 4)
  call capend
  call check('EvalPoint2', at(1, .5, .75, .375))
  call check('EvalMesh2 POINT', n == 16 .and. at(2, 0., 0., 0.) .and. at(3, .5, 0., 0.) .and. at(16, 1., 1., 1.))
  call capbeg
  call fglEvalMesh2(GL_LINE, 0, 2, 0, 4)
  call fglEvalMesh2(GL_FILL, 0, 2, 0, 4)
  call capend
  call check('EvalMesh2 LINE and FILL', n > 40 .and. all(abs(pos(1, :n) * pos(2, :n) - pos(3, :n)) <= 1e-5))
  call fglMapGrid2d(3, 1d0, 4d0, 5, -1d0, 2d0)
  call fglGetFloatv(GL_MAP2_GRID_DOMAIN, g4)
  call fglGetIntegerv(GL_MAP2_GRID_SEGMENTS, segments)
  call check('MapGrid2d', all(g4 == (/1., 4., -1., 2./)) .and. all(segments == (/3, 5/)))
  call expect('grids: no error', GL_NO_ERROR)
  call fglDisable(GL_MAP1_VERTEX_3)
  call fglDisable(GL_MAP2_VERTEX_3)
end subroutine

! The possible types of arguments like `points`: arrays of every rank, elements, sections, and holders of an address:
! character(8) as on the reference page, integer(8), type(c_ptr).
subroutine arrays
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc
  use positions
  implicit none
  real(4), target :: flat(24), cube(3, 2, 4), under(3, 2)
  real(8), target :: twice(6), back(6)
  character(8) :: holder
  character(9) :: skew
  integer(8) :: address
  type(c_ptr) :: pointer
  integer :: i
  flat = (/(real(i), i = 1, 24)/)
  cube = reshape(flat, (/3, 2, 4/))
  twice = (/7d0, 8d0, 9d0, 10d0, 11d0, 12d0/)

  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, flat), (/1., 2., 3., 4., 5., 6./))
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, flat(7)), (/7., 8., 9., 10., 11., 12./))
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 6, 2, cube(1, 2, 1)), (/4., 5., 6., 10., 11., 12./))
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, cube(:, :, 3)), (/13., 14., 15., 16., 17., 18./))
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, cube(:, 2, 1:3:2)), (/4., 5., 6., 16., 17., 18./))
  under = cube(:, :, 1)
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, 2. * under), (/2., 4., 6., 8., 10., 12./))
  HAS(passes(flat(4)), (/4., 5., 6., 7., 8., 9./))

  address = loc(flat(2))
  holder = transfer(address, holder)
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, holder), (/2., 3., 4., 5., 6., 7./))
  address = loc(flat(3))
  skew(2:9) = transfer(address, holder)  ! an odd address
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, skew(2:9)), (/3., 4., 5., 6., 7., 8./))
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, address), (/3., 4., 5., 6., 7., 8./))
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, loc(flat(5))), (/5., 6., 7., 8., 9., 10./))
  pointer = c_loc(flat(6))
  HAS(fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, pointer), (/6., 7., 8., 9., 10., 11./))

  ! The other routines that have arrays, by their holders.
  HAS(fglMap1d(GL_MAP1_VERTEX_3, 0d0, 1d0, 3, 2, loc(twice)), (/7., 8., 9., 10., 11., 12./))
  call fglGetMapdv(GL_MAP1_VERTEX_3, GL_COEFF, loc(back))
  call check('GetMapdv', all(back == twice))
  call fglMap2f(GL_MAP2_NORMAL, 0., 1., 3, 1, 0., 1., 3, 2, loc(flat))
  flat(1:6) = 0.
  call fglGetMapfv(GL_MAP2_NORMAL, GL_COEFF, loc(flat))
  call check('Map2f, GetMapfv', flat(1) == 1. .and. flat(6) == 6.)
  call fglMap2d(GL_MAP2_NORMAL, 0d0, 1d0, 3, 1, 0d0, 1d0, 3, 2, loc(twice))
  call fglGetMapdv(GL_MAP2_NORMAL, GL_COEFF, loc(back))
  call check('Map2d', all(back == twice))
  ! Only the answer is written, also into a section.
  under = -5.
  call fglGetMapfv(GL_MAP2_NORMAL, GL_DOMAIN, under(1:2, :))
  call check('a section that receives', all(under == reshape((/0., 1., -5., 0., 1., -5./), (/3, 2/))))
  call expect('arrays: no error', GL_NO_ERROR)
contains
  ! An array of assumed size.
  subroutine passes(p)
    real(4) :: p(3, *)
    call fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, p)
  end subroutine
end subroutine

! Explicit vertices and current values.
subroutine own_vertices
  use positions
  implicit none
  real(4) :: c(4)
  call capbeg
  call fglBegin(GL_POINTS)
  call fglVertex2f(.25, .5)
  call fglVertex2d(.5d0, .25d0)
  call fglVertex3f(.125, .25, .5)
  call fglVertex3d(.5d0, .125d0, .25d0)
  call fglVertex4f(.25, .5, .75, 1.)
  call fglVertex4d(.75d0, .5d0, .25d0, 1d0)
  call fglEnd
  call capend
  call check('six vertices', n == 6)
  call check('Vertex2', at(1, .25, .5, 0.) .and. at(2, .5, .25, 0.))
  call check('Vertex3', at(3, .125, .25, .5) .and. at(4, .5, .125, .25))
  call check('Vertex4', at(5, .25, .5, .75) .and. at(6, .75, .5, .25))
  CURRENT(GL_CURRENT_COLOR, fglColor3f(.25, .5, .75), (/.25, .5, .75, 1./))
  CURRENT(GL_CURRENT_COLOR, fglColor3d(.5d0, .25d0, .125d0), (/.5, .25, .125, 1./))
  CURRENT(GL_CURRENT_COLOR, fglColor4f(.25, .5, .75, .125), (/.25, .5, .75, .125/))
  CURRENT(GL_CURRENT_COLOR, fglColor4d(.5d0, .25d0, .125d0, .75d0), (/.5, .25, .125, .75/))
  CURRENT(GL_CURRENT_NORMAL, fglNormal3f(.25, .5, .75), (/.25, .5, .75, 9./))
  CURRENT(GL_CURRENT_NORMAL, fglNormal3d(.5d0, .25d0, .125d0), (/.5, .25, .125, 9./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord1f(2.), (/2., 0., 0., 1./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord1d(3d0), (/3., 0., 0., 1./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord2f(2., 3.), (/2., 3., 0., 1./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord2d(4d0, 5d0), (/4., 5., 0., 1./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord3f(2., 3., 4.), (/2., 3., 4., 1./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord3d(4d0, 5d0, 6d0), (/4., 5., 6., 1./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord4f(2., 3., 4., 5.), (/2., 3., 4., 5./))
  CURRENT(GL_CURRENT_TEXTURE_COORDS, fglTexCoord4d(4d0, 5d0, 6d0, 7d0), (/4., 5., 6., 7./))
  call expect('own vertices: no error', GL_NO_ERROR)
end subroutine

! Enable, Disable, IsEnabled; Begin and End.
subroutine switches
  use positions
  implicit none
  call check('off at first', .not. logical(fglIsEnabled(GL_MAP2_COLOR_4)))
  call fglEnable(GL_MAP2_COLOR_4)
  call check('Enable', logical(fglIsEnabled(GL_MAP2_COLOR_4)))
  call fglDisable(GL_MAP2_COLOR_4)
  call check('Disable', .not. logical(fglIsEnabled(GL_MAP2_COLOR_4)))
  call expect('switches: no error', GL_NO_ERROR)
  ERROR(GL_INVALID_ENUM, fglEnable(GL_COEFF))
  ERROR(GL_INVALID_ENUM, fglDisable(GL_COEFF))

  ! Nothing is emitted without an enabled map.
  call fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 1, (/.5, .5, 0./))
  call capbeg
  call fglEvalMesh1(GL_POINT, 0, 1)
  call capend
  call check('a map that is off', n == 0)

  ERROR(GL_INVALID_ENUM, fglBegin(GL_POLYGON + 100))
  call fglEnd
  call expect('End without Begin', GL_INVALID_OPERATION)
  ERROR_IN_PRIMITIVE(fglBegin(GL_LINES))
  ERROR_IN_PRIMITIVE(fglEnable(GL_MAP2_COLOR_4))
  call check('it is still off', .not. logical(fglIsEnabled(GL_MAP2_COLOR_4)))
  ! The first error is kept.
  call fglEnable(GL_COEFF)
  call fglEnd
  call expect('the first of two errors', GL_INVALID_ENUM)
  call expect('then none', GL_NO_ERROR)
end subroutine

! The errors of Map1 and Map2 of both types, and that a map with an error changes nothing.
subroutine map_errors
  use positions
  implicit none
  real(4) :: p(4, 200)
  real(8) :: p8(4, 200)
  integer(4) :: most, short, one, two, order(2)
  integer(4), parameter :: curves(2) = (/GL_MAP1_VERTEX_4, GL_MAP1_INDEX/), surfaces(2) = (/GL_MAP2_VERTEX_4, GL_MAP2_INDEX/)
  integer :: k
  p = 0.
  p8 = 0d0
  call fglGetIntegerv(GL_MAX_EVAL_ORDER, most)
  call check('MAX_EVAL_ORDER', most >= 8 .and. most < 200)

  ERROR(GL_INVALID_ENUM, fglMap1f(GL_MAP2_VERTEX_4, 0., 1., 4, 2, p))
  ERROR(GL_INVALID_ENUM, fglMap1d(GL_COEFF, 0d0, 1d0, 4, 2, p8))
  ERROR(GL_INVALID_ENUM, fglMap2f(GL_MAP1_VERTEX_4, 0., 1., 4, 2, 0., 1., 8, 2, p))
  ERROR(GL_INVALID_ENUM, fglMap2d(GL_COEFF, 0d0, 1d0, 4, 2, 0d0, 1d0, 8, 2, p8))

  do k = 1, 2
    one = curves(k)
    two = surfaces(k)
    call fglMap1f(one, 0., 1., 4, 3, p)
    call fglMap2f(two, 0., 1., 4, 3, 0., 1., 12, 2, p)
    call expect('maps without error', GL_NO_ERROR)

    ERROR(GL_INVALID_VALUE, fglMap1f(one, 1., 1., 4, 2, p))
    ERROR(GL_INVALID_VALUE, fglMap1d(one, 1d0, 1d0, 4, 2, p8))
    ERROR(GL_INVALID_VALUE, fglMap2f(two, 1., 1., 4, 2, 0., 1., 8, 2, p))
    ERROR(GL_INVALID_VALUE, fglMap2f(two, 0., 1., 4, 2, 1., 1., 8, 2, p))
    ERROR(GL_INVALID_VALUE, fglMap2d(two, 1d0, 1d0, 4, 2, 0d0, 1d0, 8, 2, p8))
    ERROR(GL_INVALID_VALUE, fglMap2d(two, 0d0, 1d0, 4, 2, 1d0, 1d0, 8, 2, p8))

    ! A stride of one less than the 4 values of VERTEX_4 and the value of INDEX.
    short = 6 - 3 * k
    ERROR(GL_INVALID_VALUE, fglMap1f(one, 0., 1., short, 2, p))
    ERROR(GL_INVALID_VALUE, fglMap1d(one, 0d0, 1d0, short, 2, p8))
    ERROR(GL_INVALID_VALUE, fglMap2f(two, 0., 1., short, 2, 0., 1., 8, 2, p))
    ERROR(GL_INVALID_VALUE, fglMap2f(two, 0., 1., 4, 2, 0., 1., short, 2, p))
    ERROR(GL_INVALID_VALUE, fglMap2d(two, 0d0, 1d0, short, 2, 0d0, 1d0, 8, 2, p8))
    ERROR(GL_INVALID_VALUE, fglMap2d(two, 0d0, 1d0, 4, 2, 0d0, 1d0, short, 2, p8))

    ERROR(GL_INVALID_VALUE, fglMap1f(one, 0., 1., 4, 0, p))
    ERROR(GL_INVALID_VALUE, fglMap1f(one, 0., 1., 4, most + 1, p))
    ERROR(GL_INVALID_VALUE, fglMap1d(one, 0d0, 1d0, 4, most + 1, p8))
    ERROR(GL_INVALID_VALUE, fglMap1d(one, 0d0, 1d0, 4, -1, p8))
    ERROR(GL_INVALID_VALUE, fglMap2f(two, 0., 1., 4, 0, 0., 1., 8, 2, p))
    ERROR(GL_INVALID_VALUE, fglMap2f(two, 0., 1., 4, 2, 0., 1., 8, most + 1, p))
    ERROR(GL_INVALID_VALUE, fglMap2d(two, 0d0, 1d0, 4, most + 1, 0d0, 1d0, 8, 2, p8))
    ERROR(GL_INVALID_VALUE, fglMap2d(two, 0d0, 1d0, 4, 2, 0d0, 1d0, 8, 0, p8))

    ERROR_IN_PRIMITIVE(fglMap1f(one, 0., 1., 4, 2, p))
    ERROR_IN_PRIMITIVE(fglMap1d(one, 0d0, 1d0, 4, 2, p8))
    ERROR_IN_PRIMITIVE(fglMap2f(two, 0., 1., 4, 2, 0., 1., 8, 2, p))
    ERROR_IN_PRIMITIVE(fglMap2d(two, 0d0, 1d0, 4, 2, 0d0, 1d0, 8, 2, p8))

    call fglGetMapiv(one, GL_ORDER, order)
    call check('the curve is as it was', order(1) == 3)
    call fglGetMapiv(two, GL_ORDER, order)
    call check('the surface is as it was', all(order == (/3, 2/)))
  end do
end subroutine

! The errors of GetMap and Get, which write nothing.
subroutine query_errors
  use positions
  implicit none
  real(4) :: f(4)
  real(8) :: d(4)
  integer(4) :: i(4)
  f = 77.
  d = 77d0
  i = 77
  ERROR(GL_INVALID_ENUM, fglGetMapfv(GL_COEFF, GL_ORDER, f))
  ERROR(GL_INVALID_ENUM, fglGetMapdv(GL_AUTO_NORMAL, GL_ORDER, d))
  ERROR(GL_INVALID_ENUM, fglGetMapiv(GL_POINT, GL_ORDER, i))
  ERROR(GL_INVALID_ENUM, fglGetMapfv(GL_MAP1_INDEX, GL_POINT, f))
  ERROR(GL_INVALID_ENUM, fglGetMapdv(GL_MAP1_INDEX, GL_MAP1_INDEX, d))
  ERROR(GL_INVALID_ENUM, fglGetMapiv(GL_MAP1_INDEX, 0, i))
  ERROR(GL_INVALID_ENUM, fglGetFloatv(GL_POINT, f))
  ERROR(GL_INVALID_ENUM, fglGetDoublev(GL_POINT, d))
  ERROR(GL_INVALID_ENUM, fglGetIntegerv(GL_POINT, i))
  ERROR_IN_PRIMITIVE(fglGetMapfv(GL_MAP1_INDEX, GL_ORDER, f))
  ERROR_IN_PRIMITIVE(fglGetMapdv(GL_MAP1_INDEX, GL_ORDER, d))
  ERROR_IN_PRIMITIVE(fglGetMapiv(GL_MAP1_INDEX, GL_ORDER, i))
  call check('nothing is written', all(f == 77.) .and. all(d == 77d0) .and. all(i == 77))
end subroutine

! The errors of MapGrid and EvalMesh.
subroutine mesh_errors
  use positions
  implicit none
  real(4) :: p(3) = (/.5, .5, 0./), ends(4)
  integer(4) :: segments(2)
  call fglMapGrid1f(5, 2., 3.)
  call fglMapGrid2f(6, 2., 3., 7, 4., 5.)
  call expect('grids without error', GL_NO_ERROR)
  ERROR(GL_INVALID_VALUE, fglMapGrid1f(0, 0., 1.))
  ERROR(GL_INVALID_VALUE, fglMapGrid1d(-1, 0d0, 1d0))
  ERROR(GL_INVALID_VALUE, fglMapGrid2f(0, 0., 1., 1, 0., 1.))
  ERROR(GL_INVALID_VALUE, fglMapGrid2d(1, 0d0, 1d0, -1, 0d0, 1d0))
  ERROR_IN_PRIMITIVE(fglMapGrid1f(1, 0., 1.))
  ERROR_IN_PRIMITIVE(fglMapGrid1d(1, 0d0, 1d0))
  ERROR_IN_PRIMITIVE(fglMapGrid2f(1, 0., 1., 1, 0., 1.))
  ERROR_IN_PRIMITIVE(fglMapGrid2d(1, 0d0, 1d0, 1, 0d0, 1d0))
  call fglGetIntegerv(GL_MAP1_GRID_SEGMENTS, segments)
  call check('the grid of curves is as it was', segments(1) == 5)
  call fglGetIntegerv(GL_MAP2_GRID_SEGMENTS, segments)
  call fglGetFloatv(GL_MAP2_GRID_DOMAIN, ends)
  call check('the grid of surfaces is as it was', all(segments == (/6, 7/)) .and. all(ends == (/2., 3., 4., 5./)))

  call fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 1, p)
  call fglMap2f(GL_MAP2_VERTEX_3, 0., 1., 3, 1, 0., 1., 3, 1, p)
  call fglEnable(GL_MAP1_VERTEX_3)
  call fglEnable(GL_MAP2_VERTEX_3)
  call expect('maps without error', GL_NO_ERROR)
  call capbeg
  ERROR(GL_INVALID_ENUM, fglEvalMesh1(GL_FILL, 0, 1))
  ERROR(GL_INVALID_ENUM, fglEvalMesh2(GL_POINTS, 0, 1, 0, 1))
  ERROR_IN_PRIMITIVE(fglEvalMesh1(GL_POINT, 0, 1))
  ERROR_IN_PRIMITIVE(fglEvalMesh2(GL_POINT, 0, 1, 0, 1))
  call capend
  call check('nothing is drawn', n == 0)
  call fglDisable(GL_MAP1_VERTEX_3)
  call fglDisable(GL_MAP2_VERTEX_3)
end subroutine
