C     Makes all calls with libfglev and a sink in Fortran; tests its own
C     routines, and calls without a context.
      PROGRAM PRODUC
      INCLUDE 'fglev.inc'
      EXTERNAL PRIMBE, PRIMVX, PRIMEN
      INTEGER*8 FIRST, SECOND, NONE
      INTEGER*4 ORD
      REAL*4 P(3, 2)
      DATA P /0., 0., 0., 1., 1., 1./
      NONE = 0

      ORD = 55
      CALL fglEnable(GL_COEFF)
      CALL fglGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, ORD)
      CALL CHECK('without a context nothing is written', ORD .EQ. 55)
      CALL EXPECT('without a context no error', GL_NO_ERROR)
      CALL CHECK('nothing is enabled',
     &  .NOT. LOGICAL(fglIsEnabled(GL_MAP1_VERTEX_3)))
      CALL CHECK('SetSink without a context', fglevSetSink(PRIMBE,
     &  PRIMVX, PRIMEN) .EQ. GLEV_ERROR_INVALID_ARGUMENT)

      CALL CHECK('CreateContext',
     &  fglevCreateContext(FIRST) .EQ. GLEV_SUCCESS .AND. FIRST .NE. 0)
      CALL fglevMakeCurrent(FIRST)
      CALL CHECK('SetSink', fglevSetSink(PRIMBE, PRIMVX, PRIMEN) .EQ.
     &  GLEV_SUCCESS)
      CALL fglBegin(GL_POINTS)
      CALL CHECK('SetSink in a primitive', fglevSetSink(PRIMBE, PRIMVX,
     &  PRIMEN) .EQ. GLEV_ERROR_IN_PRIMITIVE)
      CALL fglEnd
      CALL CHECK('name of a result', fglevGetResultString(
     &  GLEV_ERROR_IN_PRIMITIVE) .EQ. 'GLEV_ERROR_IN_PRIMITIVE')
      CALL CHECK('no name', fglevGetResultString(-1) .EQ.
     &  'unknown result')
      CALL CALLS

C     Each context has its own state and errors.
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, P)
      CALL CHECK('CreateContext again',
     &  fglevCreateContext(SECOND) .EQ. GLEV_SUCCESS)
      CALL fglEnable(GL_COEFF)
      CALL fglevMakeCurrent(SECOND)
      CALL EXPECT('the error is the first context''s', GL_NO_ERROR)
      CALL fglGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, ORD)
      CALL CHECK('the map is the first context''s', ORD .EQ. 1)
      CALL fglevMakeCurrent(FIRST)
      CALL EXPECT('the error has waited', GL_INVALID_ENUM)
      CALL fglevDestroyContext(SECOND)
      CALL CHECK('DestroyContext of another', SECOND .EQ. 0)
      CALL fglGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, ORD)
      CALL CHECK('the first context goes on', ORD .EQ. 2)
      CALL fglevDestroyContext(FIRST)
      CALL fglEnable(GL_COEFF)
      CALL EXPECT('DestroyContext: none is current', GL_NO_ERROR)
      CALL fglevDestroyContext(NONE)
      CALL fglevMakeCurrent(NONE)
      CALL FINISH
      END

C     The sink keeps the vertices between CAPBEG and CAPEND.
      SUBROUTINE PRIMBE(MODE)
      INTEGER*4 MODE
      LOGICAL OPEN
      COMMON /PRIMIT/ OPEN
      CALL CHECK('a primitive begins', .NOT. OPEN .AND. MODE .GE. 0
     &  .AND. MODE .LE. 9)
      OPEN = .TRUE.
      END

      SUBROUTINE PRIMVX(POSITN, COLOR, NORMAL, TEXC)
      REAL*4 POSITN(4), COLOR(4), NORMAL(3), TEXC(4, 8)
      LOGICAL OPEN
      COMMON /PRIMIT/ OPEN
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      CALL CHECK('a vertex belongs to a primitive', OPEN)
      CALL CHECK('it has initial values', ALL(COLOR .EQ. 1.) .AND.
     &  ALL(NORMAL .EQ. (/0., 0., 1./)) .AND. ALL(TEXC(1:3, :) .EQ. 0.)
     &  .AND. ALL(TEXC(4, :) .EQ. 1.) .AND. POSITN(4) .EQ. 1.)
      N = MIN(N + 1, 1000)
      POS(:, N) = POSITN(1:3)
      END

      SUBROUTINE PRIMEN
      LOGICAL OPEN
      COMMON /PRIMIT/ OPEN
      CALL CHECK('a primitive ends', OPEN)
      OPEN = .FALSE.
      END

      SUBROUTINE CAPBEG
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      N = 0
      END

      SUBROUTINE CAPEND
      END
