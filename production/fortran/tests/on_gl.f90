! Makes all calls with libfgl and the GL of OSMesa; the feedback buffer shows the vertices. A library in LD_PRELOAD that
! replaces commands of OSMesa is tested instead of OSMesa.
module capture
  use, intrinsic :: iso_c_binding
  implicit none
  integer(4), parameter :: size = 100000, render = 7168, feedback = 7169, three_d = 1537
  real(4), target :: buffer(size)
  interface
    function OSMesaCreateContextExt(format, depth, stencil, accum, shared) &
        bind(c, name='OSMesaCreateContextExt') result(context)
      import
      integer(c_int), value :: format, depth, stencil, accum
      type(c_ptr), value :: shared
      type(c_ptr) :: context
    end function
    function OSMesaMakeCurrent(context, memory, type, width, height) &
        bind(c, name='OSMesaMakeCurrent') result(made)
      import
      type(c_ptr), value :: context, memory
      integer(c_int), value :: type, width, height
      integer(c_signed_char) :: made
    end function
    subroutine glFeedbackBuffer(size, type, buffer) &
        bind(c, name='glFeedbackBuffer')
      import
      integer(c_int), value :: size, type
      real(c_float) :: buffer(*)
    end subroutine
    function glRenderMode(mode) &
        bind(c, name='glRenderMode') result(count)
      import
      integer(c_int), value :: mode
      integer(c_int) :: count
    end function
  end interface
end module

program on_gl
  use capture
  implicit none
  integer(c_signed_char), target :: image(4, 2, 2)
  type(c_ptr) :: context
  context = OSMesaCreateContextExt(6408, 24, 0, 0, c_null_ptr)
  if (.not. c_associated(context)) error stop 'no context'
  if (OSMesaMakeCurrent(context, c_loc(image), 5121, 2, 2) == 0) error stop 'context cannot be made current'
  call glFeedbackBuffer(size, three_d, buffer)
  call calls
  call finish
end program

subroutine capbeg
  use capture
  implicit none
  integer(4) :: left
  left = glRenderMode(feedback)
end subroutine

! Window coordinates of a window of 2 x 2 pixels: x + 1, y + 1, (z + 1) / 2.
subroutine capend
  use capture
  implicit none
  integer :: n, i, j, corners
  real(4) :: pos(3, 1000)
  common /captur/ n, pos
  integer(4) :: values
  values = glRenderMode(render)
  n = 0
  i = 1
  do while (i <= values)
    select case (nint(buffer(i)))
    case (1793) ! POINT_TOKEN
      corners = 1
    case (1794, 1799) ! LINE_TOKEN, LINE_RESET_TOKEN
      corners = 2
    case (1795) ! POLYGON_TOKEN
      i = i + 1
      corners = nint(buffer(i))
    case default
      error stop 'not a token of the feedback buffer'
    end select
    i = i + 1
    do j = 1, corners
      n = min(n + 1, 1000)
      pos(:, n) = [buffer(i) - 1, buffer(i + 1) - 1, 2 * buffer(i + 2) - 1]
      i = i + 3
    end do
  end do
end subroutine
