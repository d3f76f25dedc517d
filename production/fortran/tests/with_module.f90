! Uses the module fglev in a modern free-form program, with a sink of module procedures.
module points
  implicit none
  real(4) :: last(4) = 0
  integer :: count = 0
contains
  subroutine begin(mode)
    integer(4), intent(in) :: mode
    if (mode /= 3) error stop 'not a line strip'
  end subroutine
  subroutine vertex(position, color, normal, texcoord)
    real(4), intent(in) :: position(4), color(4), normal(3), texcoord(4, 8)
    if (any(color /= [1., 1., 1., 1.]) .or. any(normal /= [0., 0., 1.]) .or. any(texcoord(4, :) /= 1)) error stop 'not initial'
    last = position
    count = count + 1
  end subroutine
  subroutine finish()
    count = count + 1000
  end subroutine
end module

program with_module
  use, intrinsic :: iso_c_binding
  use fglev
  use points
  implicit none
  integer(8) :: context
  real(8), target :: control(4, 3) = reshape([real(8) :: 1, 0, 0, 1, 1, 1, 0, 1, 0, 2, 0, 2], [4, 3])
  real(4) :: back(4, 3)
  integer(4) :: order

  if (fglevCreateContext(context) /= GLEV_SUCCESS) error stop 'no context'
  call fglevMakeCurrent(context)
  if (fglevSetSink(begin, vertex, finish) /= GLEV_SUCCESS) error stop 'no sink'

  ! A quarter of a circle, exactly: (1 - u**2, 2u, 1 + u**2).
  call fglMap1d(GL_MAP1_VERTEX_4, 0d0, 1d0, 4, 3, control)
  call fglEnable(GL_MAP1_VERTEX_4)
  call fglMapGrid1d(2, 0d0, 1d0)
  call fglEvalMesh1(GL_LINE, 0, 1)
  if (count /= 1002) error stop 'not two vertices'
  if (any(last /= [0.75, 1., 0., 1.25])) error stop 'not the point at 1/2'

  call fglMap1d(GL_MAP1_VERTEX_4, 0d0, 1d0, 4, 2, c_loc(control(1, 2)))
  call fglGetMapfv(GL_MAP1_VERTEX_4, GL_COEFF, back)
  call fglGetMapiv(GL_MAP1_VERTEX_4, GL_ORDER, order)
  if (order /= 2 .or. any(back(:, 1:2) /= control(:, 2:3))) error stop 'not the control points'
  if (.not. fglIsEnabled(GL_MAP1_VERTEX_4)) error stop 'not enabled'
  call fglEvalMesh1(GL_FILL, 0, 1)
  if (fglGetError() /= GL_INVALID_ENUM) error stop 'not an error'
  call fglevDestroyContext(context)
  if (context /= 0) error stop 'not destroyed'
end program
