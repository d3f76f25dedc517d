! Tests that each thread has its own current context.
program threads
  use fglev
  implicit none
  integer, external :: omp_get_thread_num
  integer(8) :: context
  integer(4) :: order, expected
  real(4) :: control(3, 4)
  integer :: wrong
  control = 0
  wrong = 0
  !$omp parallel num_threads(4) private(context, order, expected) reduction(+: wrong)
  if (fglevCreateContext(context) /= GLEV_SUCCESS) wrong = wrong + 1
  call fglevMakeCurrent(context)
  expected = 1 + omp_get_thread_num()
  call fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, expected, control)
  !$omp barrier
  call fglGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, order)
  if (order /= expected) wrong = wrong + 1
  call fglevDestroyContext(context)
  !$omp end parallel
  if (wrong /= 0) error stop 'a thread saw the context of another'
end program
