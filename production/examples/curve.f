C     A curve, point by point: the GL commands in fixed-form Fortran,
C     and a sink that gets the vertices. curve.c does the same in C.
      PROGRAM CURVE
      INCLUDE 'fglev.inc'
      EXTERNAL BEGINS, PRINTS, ENDS
      INTEGER*8 GL
      INTEGER*4 CODE
      REAL*4 POINTS(3, 4)
      DATA POINTS /0., 0., 0., 1., 2., .5, 3., 2., 1., 4., 0., 2./
      IF (fglevCreateContext(GL) .NE. GLEV_SUCCESS) STOP 1
      CALL fglevMakeCurrent(GL)
      IF (fglevSetSink(BEGINS, PRINTS, ENDS) .NE. GLEV_SUCCESS) STOP 1

      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 4, POINTS)
      CALL fglEnable(GL_MAP1_VERTEX_3)
      CALL fglMapGrid1f(10, 0., 1.)
      CALL fglEvalMesh1(GL_LINE, 0, 10)

      CODE = fglGetError()
      CALL fglevDestroyContext(GL)
      IF (CODE .NE. GL_NO_ERROR) STOP 1
      END

      SUBROUTINE BEGINS(MODE)
      INTEGER*4 MODE
      END

      SUBROUTINE PRINTS(POSITN, COLOR, NORMAL, TEXCRD)
      REAL*4 POSITN(4), COLOR(4), NORMAL(3), TEXCRD(4, 8)
      WRITE (*, '(3F12.6)') POSITN(1), POSITN(2), POSITN(3)
      END

      SUBROUTINE ENDS
      END
