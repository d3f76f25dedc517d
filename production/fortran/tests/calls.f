C     Tests every routine of the binding against the GL's rules, in
C     fixed form with the declarations. The main program captures the
C     positions of vertices between CAPBEG and CAPEND.
      SUBROUTINE CALLS
      CALL CURVES
      CALL SURFAC
      CALL GRIDS
      CALL ARRAYS
      CALL OWNVTX
      CALL SWITCH
      CALL MAPERR
      CALL QRYERR
      CALL MSHERR
      END

C     Returns true if captured vertex I is at (X, Y, Z).
      LOGICAL FUNCTION AT(I, X, Y, Z)
      INTEGER I
      REAL*4 X, Y, Z
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      AT = I .LE. N .AND. ABS(POS(1, I) - X) .LT. 1E-5 .AND.
     &  ABS(POS(2, I) - Y) .LT. 1E-5 .AND. ABS(POS(3, I) - Z) .LT. 1E-5
      END

C     Map1, EvalCoord1 in its four forms. Order 3, so that the curve is
C     (2u - 1, 2u(1 - u), 0), over (0,1) and over (1,3).
      SUBROUTINE CURVES
      INCLUDE 'fgl.inc'
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      LOGICAL AT
      REAL*4 P(3, 3), Q(5, 3), U(1), V4(9)
      REAL*8 P8(3, 3), U8(1), V8(9), ENDS(2)
      INTEGER*4 VI(9), ORD
      INTEGER I, J
      DATA P /-1., 0., 0., 0., 1., 0., 1., 0., 0./
      DO 20 J = 1, 3
        DO 10 I = 1, 3
          P8(I, J) = P(I, J)
          Q(I, J) = P(I, J)
   10   CONTINUE
        Q(4, J) = 7.
        Q(5, J) = 9.
   20 CONTINUE
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 3, P)
      CALL fglEnable(GL_MAP1_VERTEX_3)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglEvalCoord1f(0.)
      CALL fglEvalCoord1d(0.25D0)
      U(1) = 0.5
      CALL fglEvalCoord1fv(U)
      U8(1) = 1D0
      CALL fglEvalCoord1dv(U8)
      CALL fglEvalCoord1fv(U(1))
      CALL fglEnd
      CALL CAPEND
      CALL CHECK('Map1f: five vertices', N .EQ. 5)
      CALL CHECK('EvalCoord1f at 0', AT(1, -1., 0., 0.))
      CALL CHECK('EvalCoord1d at 1/4', AT(2, -.5, .375, 0.))
      CALL CHECK('EvalCoord1fv at 1/2', AT(3, 0., .5, 0.))
      CALL CHECK('EvalCoord1dv at 1', AT(4, 1., 0., 0.))
      CALL CHECK('EvalCoord1fv of an element', AT(5, 0., .5, 0.))

C     A larger stride, another domain, doubles.
      CALL fglMap1f(GL_MAP1_VERTEX_3, 1., 3., 5, 3, Q)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglEvalCoord1f(1.5)
      CALL fglEnd
      CALL CAPEND
      CALL CHECK('Map1f, stride 5 over (1,3)', AT(1, -.5, .375, 0.))
      CALL fglGetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, V4)
      CALL CHECK('GetMapfv COEFF without what is between',
     &  V4(1) .EQ. -1. .AND. V4(5) .EQ. 1. .AND. V4(7) .EQ. 1.)
      CALL fglMap1d(GL_MAP1_VERTEX_3, -1D0, 1D0, 3, 3, P8)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglEvalCoord1d(0D0)
      CALL fglEnd
      CALL CAPEND
      CALL CHECK('Map1d over (-1,1)', N .EQ. 1 .AND. AT(1, 0., .5, 0.))

C     Stored values.
      CALL fglGetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN, ENDS)
      CALL CHECK('GetMapdv DOMAIN',
     &  ENDS(1) .EQ. -1D0 .AND. ENDS(2) .EQ. 1D0)
      CALL fglGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, ORD)
      CALL CHECK('GetMapiv ORDER', ORD .EQ. 3)
      CALL fglGetMapdv(GL_MAP1_VERTEX_3, GL_COEFF, V8)
      CALL CHECK('GetMapdv COEFF', V8(1) .EQ. -1D0 .AND.
     &  V8(4) .EQ. 0D0 .AND. V8(5) .EQ. 1D0 .AND. V8(7) .EQ. 1D0)
      CALL fglGetMapiv(GL_MAP1_VERTEX_3, GL_COEFF, VI)
      CALL CHECK('GetMapiv COEFF', VI(1) .EQ. -1 .AND. VI(5) .EQ. 1)
      CALL EXPECT('curves: no error', GL_NO_ERROR)
      CALL fglDisable(GL_MAP1_VERTEX_3)
      END

C     Map2, EvalCoord2 in its four forms. Of order 2 in u and 3 in v,
C     (u, v*v, u*v): control point (i,j) is (i, [j = 2], i*j/2). The
C     array is P(3, u, v), and R(3, v, u) the other way round.
      SUBROUTINE SURFAC
      INCLUDE 'fgl.inc'
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      LOGICAL AT
      REAL*4 P(3, 2, 3), UV(2), ENDS(4)
      REAL*8 R(3, 3, 2), UV8(2)
      INTEGER*4 ORD(2), VI(18)
      INTEGER I, J
      DO 20 J = 1, 3
        DO 10 I = 1, 2
          P(1, I, J) = I - 1
          P(2, I, J) = (J - 1) / 2
          P(3, I, J) = (I - 1) * (J - 1) * .5
          R(1, J, I) = P(1, I, J)
          R(2, J, I) = P(2, I, J)
          R(3, J, I) = P(3, I, J)
   10   CONTINUE
   20 CONTINUE
      CALL fglEnable(GL_MAP2_VERTEX_3)
      CALL fglMap2f(GL_MAP2_VERTEX_3, 0., 1., 3, 2, 0., 1., 6, 3, P)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglEvalCoord2f(.25, .5)
      CALL fglEvalCoord2d(.5D0, .25D0)
      UV(1) = 1.
      UV(2) = .5
      CALL fglEvalCoord2fv(UV)
      UV8(1) = .5D0
      UV8(2) = 1D0
      CALL fglEvalCoord2dv(UV8)
      CALL fglEnd
      CALL CAPEND
      CALL CHECK('Map2f: four vertices', N .EQ. 4)
      CALL CHECK('EvalCoord2f', AT(1, .25, .25, .125))
      CALL CHECK('EvalCoord2d', AT(2, .5, .0625, .125))
      CALL CHECK('EvalCoord2fv', AT(3, 1., .25, .5))
      CALL CHECK('EvalCoord2dv', AT(4, .5, 1., .5))

      CALL fglMap2d(GL_MAP2_VERTEX_3, 0D0, 2D0, 9, 2, -1D0, 1D0, 3, 3,
     &  R)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglEvalCoord2d(.5D0, 0D0)
      CALL fglEnd
      CALL CAPEND
      CALL CHECK('Map2d', N .EQ. 1 .AND. AT(1, .25, .25, .125))
      CALL fglGetMapfv(GL_MAP2_VERTEX_3, GL_DOMAIN, ENDS)
      CALL CHECK('GetMapfv DOMAIN', ENDS(1) .EQ. 0. .AND. ENDS(2) .EQ.
     &  2. .AND. ENDS(3) .EQ. -1. .AND. ENDS(4) .EQ. 1.)
      CALL fglGetMapiv(GL_MAP2_VERTEX_3, GL_ORDER, ORD)
      CALL CHECK('GetMapiv ORDER, u before v',
     &  ORD(1) .EQ. 2 .AND. ORD(2) .EQ. 3)
      CALL fglGetMapiv(GL_MAP2_VERTEX_3, GL_COEFF, VI)
      CALL CHECK('GetMapiv COEFF, v fastest', VI(1) .EQ. 0 .AND.
     &  VI(8) .EQ. 1 .AND. VI(10) .EQ. 1 .AND. VI(17) .EQ. 1)
      CALL EXPECT('surfaces: no error', GL_NO_ERROR)
      CALL fglDisable(GL_MAP2_VERTEX_3)
      END

C     MapGrid, EvalPoint, EvalMesh. The curve is (u, u, 0), the surface
C     (u, v, uv).
      SUBROUTINE GRIDS
      INCLUDE 'fgl.inc'
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      LOGICAL AT
      REAL*4 P(3, 2), Q(3, 2, 2), G4(4)
      REAL*8 G8(2)
      INTEGER*4 SEG(2)
      INTEGER I
      LOGICAL ON
      DATA P /0., 0., 0., 1., 1., 0./
      DATA Q /0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 1./
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, P)
      CALL fglMap2f(GL_MAP2_VERTEX_3, 0., 1., 3, 2, 0., 1., 6, 2, Q)
      CALL fglEnable(GL_MAP1_VERTEX_3)
      CALL fglEnable(GL_MAP2_VERTEX_3)

      CALL fglMapGrid1f(4, 0., 1.)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglEvalPoint1(1)
      CALL fglEnd
      CALL fglEvalMesh1(GL_POINT, 2, 4)
      CALL CAPEND
      CALL CHECK('EvalPoint1 and EvalMesh1', N .EQ. 4 .AND.
     &  AT(1, .25, .25, 0.) .AND. AT(2, .5, .5, 0.) .AND.
     &  AT(4, 1., 1., 0.))
      CALL CAPBEG
      CALL fglEvalMesh1(GL_LINE, 0, 4)
      CALL CAPEND
      CALL CHECK('EvalMesh1 LINE', N .GE. 5 .AND. AT(1, 0., 0., 0.)
     &  .AND. AT(N, 1., 1., 0.))
      CALL fglMapGrid1d(2, .5D0, 1D0)
      CALL fglGetDoublev(GL_MAP1_GRID_DOMAIN, G8)
      CALL fglGetIntegerv(GL_MAP1_GRID_SEGMENTS, SEG)
      CALL CHECK('MapGrid1d', G8(1) .EQ. .5D0 .AND. G8(2) .EQ. 1D0
     &  .AND. SEG(1) .EQ. 2)
      CALL CAPBEG
      CALL fglEvalMesh1(GL_POINT, 1, 1)
      CALL CAPEND
      CALL CHECK('its middle', N .EQ. 1 .AND. AT(1, .75, .75, 0.))

      CALL fglMapGrid2f(2, 0., 1., 4, 0., 1.)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglEvalPoint2(1, 3)
      CALL fglEnd
      CALL fglEvalMesh2(GL_POINT, 0, 2, 0, 4)
      CALL CAPEND
      CALL CHECK('EvalPoint2', AT(1, .5, .75, .375))
      CALL CHECK('EvalMesh2 POINT', N .EQ. 16 .AND. AT(2, 0., 0., 0.)
     &  .AND. AT(3, .5, 0., 0.) .AND. AT(16, 1., 1., 1.))
      CALL CAPBEG
      CALL fglEvalMesh2(GL_LINE, 0, 2, 0, 4)
      CALL fglEvalMesh2(GL_FILL, 0, 2, 0, 4)
      CALL CAPEND
      ON = N .GT. 40
      DO 10 I = 1, N
        IF (ABS(POS(1, I) * POS(2, I) - POS(3, I)) .GT. 1E-5) ON =
     &    .FALSE.
   10 CONTINUE
      CALL CHECK('EvalMesh2 LINE and FILL', ON)
      CALL fglMapGrid2d(3, 1D0, 4D0, 5, -1D0, 2D0)
      CALL fglGetFloatv(GL_MAP2_GRID_DOMAIN, G4)
      CALL fglGetIntegerv(GL_MAP2_GRID_SEGMENTS, SEG)
      CALL CHECK('MapGrid2d', G4(1) .EQ. 1. .AND. G4(2) .EQ. 4. .AND.
     &  G4(3) .EQ. -1. .AND. G4(4) .EQ. 2. .AND. SEG(1) .EQ. 3 .AND.
     &  SEG(2) .EQ. 5)
      CALL EXPECT('grids: no error', GL_NO_ERROR)
      CALL fglDisable(GL_MAP1_VERTEX_3)
      CALL fglDisable(GL_MAP2_VERTEX_3)
      END

C     The possible types of arguments like `points`: arrays of every
C     rank, elements, sections, and holders of an address: CHARACTER*8
C     as on the reference page, INTEGER*8, TYPE(C_PTR).
      SUBROUTINE ARRAYS
      USE, INTRINSIC :: ISO_C_BINDING, ONLY: C_PTR, C_LOC
      INCLUDE 'fgl.inc'
      LOGICAL HASMAP
      REAL*4, TARGET :: FLAT(24), CUBE(3, 2, 4), UNDER(3, 2)
      REAL*8, TARGET :: TWICE(6), BACK(6)
      CHARACTER*8 HOLDER
      CHARACTER*9 SKEW
      INTEGER*8 ADDR
      TYPE(C_PTR) WHERE
      INTEGER I
      DO 10 I = 1, 24
        FLAT(I) = I
   10 CONTINUE
      CUBE = RESHAPE(FLAT, (/3, 2, 4/))
      TWICE = (/7D0, 8D0, 9D0, 10D0, 11D0, 12D0/)

      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, FLAT)
      CALL CHECK('an array of rank 1', HASMAP(1., 2., 3., 4., 5., 6.))
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, FLAT(7))
      CALL CHECK('an element', HASMAP(7., 8., 9., 10., 11., 12.))
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 6, 2, CUBE(1, 2, 1))
      CALL CHECK('an element and a stride',
     &  HASMAP(4., 5., 6., 10., 11., 12.))
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, CUBE(:, :, 3))
      CALL CHECK('a section', HASMAP(13., 14., 15., 16., 17., 18.))
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, CUBE(:, 2, 1:3:2))
      CALL CHECK('a section with gaps',
     &  HASMAP(4., 5., 6., 16., 17., 18.))
      UNDER = CUBE(:, :, 1)
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, 2. * UNDER)
      CALL CHECK('an expression', HASMAP(2., 4., 6., 8., 10., 12.))
      CALL PASSES(FLAT(4))
      CALL CHECK('an array of assumed size',
     &  HASMAP(4., 5., 6., 7., 8., 9.))

      ADDR = LOC(FLAT(2))
      HOLDER = TRANSFER(ADDR, HOLDER)
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, HOLDER)
      CALL CHECK('CHARACTER*8', HASMAP(2., 3., 4., 5., 6., 7.))
      ADDR = LOC(FLAT(3))
      SKEW(2:9) = TRANSFER(ADDR, HOLDER)
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, SKEW(2:9))
      CALL CHECK('CHARACTER*8 at an odd address',
     &  HASMAP(3., 4., 5., 6., 7., 8.))
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, ADDR)
      CALL CHECK('INTEGER*8', HASMAP(3., 4., 5., 6., 7., 8.))
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, LOC(FLAT(5)))
      CALL CHECK('LOC', HASMAP(5., 6., 7., 8., 9., 10.))
      WHERE = C_LOC(FLAT(6))
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, WHERE)
      CALL CHECK('TYPE(C_PTR)', HASMAP(6., 7., 8., 9., 10., 11.))

C     The other routines that have arrays, by their holders.
      CALL fglMap1d(GL_MAP1_VERTEX_3, 0D0, 1D0, 3, 2, LOC(TWICE))
      CALL CHECK('Map1d', HASMAP(7., 8., 9., 10., 11., 12.))
      CALL fglGetMapdv(GL_MAP1_VERTEX_3, GL_COEFF, LOC(BACK))
      CALL CHECK('GetMapdv', ALL(BACK .EQ. TWICE))
      CALL fglMap2f(GL_MAP2_NORMAL, 0., 1., 3, 1, 0., 1., 3, 2,
     &  LOC(FLAT))
      FLAT(1:6) = 0.
      CALL fglGetMapfv(GL_MAP2_NORMAL, GL_COEFF, LOC(FLAT))
      CALL CHECK('Map2f, GetMapfv', FLAT(1) .EQ. 1. .AND. FLAT(6) .EQ.
     &  6.)
      CALL fglMap2d(GL_MAP2_NORMAL, 0D0, 1D0, 3, 1, 0D0, 1D0, 3, 2,
     &  LOC(TWICE))
      CALL fglGetMapdv(GL_MAP2_NORMAL, GL_COEFF, LOC(BACK))
      CALL CHECK('Map2d', ALL(BACK .EQ. TWICE))
C     Only the answer is written, also into a section.
      UNDER = -5.
      CALL fglGetMapfv(GL_MAP2_NORMAL, GL_DOMAIN, UNDER(1:2, :))
      CALL CHECK('a section that receives', ALL(UNDER(1:2, 1) .EQ.
     &  (/0., 1./)) .AND. ALL(UNDER(1:2, 2) .EQ. (/0., 1./)) .AND.
     &  ALL(UNDER(3, :) .EQ. -5.))
      CALL EXPECT('arrays: no error', GL_NO_ERROR)
      END

      SUBROUTINE PASSES(P)
      INCLUDE 'fgl.inc'
      REAL*4 P(3, *)
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 2, P)
      END

C     Returns true if MAP1_VERTEX_3 has the points (A,B,C), (D,E,F).
      LOGICAL FUNCTION HASMAP(A, B, C, D, E, F)
      INCLUDE 'fgl.inc'
      REAL*4 A, B, C, D, E, F, V(6)
      V = -1.
      CALL fglGetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, V)
      HASMAP = ALL(V .EQ. (/A, B, C, D, E, F/))
      END

C     Explicit vertices and current values.
      SUBROUTINE OWNVTX
      INCLUDE 'fgl.inc'
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      LOGICAL AT
      REAL*4 C(4)
      CALL CAPBEG
      CALL fglBegin(GL_POINTS)
      CALL fglVertex2f(.25, .5)
      CALL fglVertex2d(.5D0, .25D0)
      CALL fglVertex3f(.125, .25, .5)
      CALL fglVertex3d(.5D0, .125D0, .25D0)
      CALL fglVertex4f(.25, .5, .75, 1.)
      CALL fglVertex4d(.75D0, .5D0, .25D0, 1D0)
      CALL fglEnd
      CALL CAPEND
      CALL CHECK('six vertices', N .EQ. 6)
      CALL CHECK('Vertex2', AT(1, .25, .5, 0.) .AND. AT(2, .5, .25,
     &  0.))
      CALL CHECK('Vertex3', AT(3, .125, .25, .5) .AND. AT(4, .5, .125,
     &  .25))
      CALL CHECK('Vertex4', AT(5, .25, .5, .75) .AND. AT(6, .75, .5,
     &  .25))
      CALL fglColor3f(.25, .5, .75)
      CALL fglGetFloatv(GL_CURRENT_COLOR, C)
      CALL CHECK('Color3f', ALL(C .EQ. (/.25, .5, .75, 1./)))
      CALL fglColor3d(.5D0, .25D0, .125D0)
      CALL fglGetFloatv(GL_CURRENT_COLOR, C)
      CALL CHECK('Color3d', ALL(C .EQ. (/.5, .25, .125, 1./)))
      CALL fglColor4f(.25, .5, .75, .125)
      CALL fglGetFloatv(GL_CURRENT_COLOR, C)
      CALL CHECK('Color4f', ALL(C .EQ. (/.25, .5, .75, .125/)))
      CALL fglColor4d(.5D0, .25D0, .125D0, .75D0)
      CALL fglGetFloatv(GL_CURRENT_COLOR, C)
      CALL CHECK('Color4d', ALL(C .EQ. (/.5, .25, .125, .75/)))
      C(4) = 9.
      CALL fglNormal3f(.25, .5, .75)
      CALL fglGetFloatv(GL_CURRENT_NORMAL, C)
      CALL CHECK('Normal3f', ALL(C .EQ. (/.25, .5, .75, 9./)))
      CALL fglNormal3d(.5D0, .25D0, .125D0)
      CALL fglGetFloatv(GL_CURRENT_NORMAL, C)
      CALL CHECK('Normal3d', ALL(C .EQ. (/.5, .25, .125, 9./)))
      CALL fglTexCoord1f(2.)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord1f', ALL(C .EQ. (/2., 0., 0., 1./)))
      CALL fglTexCoord1d(3D0)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord1d', ALL(C .EQ. (/3., 0., 0., 1./)))
      CALL fglTexCoord2f(2., 3.)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord2f', ALL(C .EQ. (/2., 3., 0., 1./)))
      CALL fglTexCoord2d(4D0, 5D0)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord2d', ALL(C .EQ. (/4., 5., 0., 1./)))
      CALL fglTexCoord3f(2., 3., 4.)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord3f', ALL(C .EQ. (/2., 3., 4., 1./)))
      CALL fglTexCoord3d(4D0, 5D0, 6D0)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord3d', ALL(C .EQ. (/4., 5., 6., 1./)))
      CALL fglTexCoord4f(2., 3., 4., 5.)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord4f', ALL(C .EQ. (/2., 3., 4., 5./)))
      CALL fglTexCoord4d(4D0, 5D0, 6D0, 7D0)
      CALL fglGetFloatv(GL_CURRENT_TEXTURE_COORDS, C)
      CALL CHECK('TexCoord4d', ALL(C .EQ. (/4., 5., 6., 7./)))
      CALL EXPECT('own vertices: no error', GL_NO_ERROR)
      END

C     Enable, Disable, IsEnabled; Begin and End.
      SUBROUTINE SWITCH
      INCLUDE 'fgl.inc'
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      REAL*4 P(3)
      DATA P /.5, .5, 0./
      CALL CHECK('off at first',
     &  .NOT. LOGICAL(fglIsEnabled(GL_MAP2_COLOR_4)))
      CALL fglEnable(GL_MAP2_COLOR_4)
      CALL CHECK('Enable', LOGICAL(fglIsEnabled(GL_MAP2_COLOR_4)))
      CALL fglDisable(GL_MAP2_COLOR_4)
      CALL CHECK('Disable',
     &  .NOT. LOGICAL(fglIsEnabled(GL_MAP2_COLOR_4)))
      CALL EXPECT('switches: no error', GL_NO_ERROR)
      CALL fglEnable(GL_COEFF)
      CALL EXPECT('Enable: not a capability', GL_INVALID_ENUM)
      CALL fglDisable(GL_COEFF)
      CALL EXPECT('Disable: not a capability', GL_INVALID_ENUM)

C     Nothing is emitted without an enabled map.
      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 1, P)
      CALL CAPBEG
      CALL fglEvalMesh1(GL_POINT, 0, 1)
      CALL CAPEND
      CALL CHECK('a map that is off', N .EQ. 0)

      CALL fglBegin(GL_POLYGON + 100)
      CALL EXPECT('Begin: not a primitive', GL_INVALID_ENUM)
      CALL fglEnd
      CALL EXPECT('End without Begin', GL_INVALID_OPERATION)
      CALL fglBegin(GL_LINES)
      CALL fglBegin(GL_LINES)
      CALL fglEnd
      CALL EXPECT('Begin after Begin', GL_INVALID_OPERATION)
      CALL fglBegin(GL_LINES)
      CALL fglEnable(GL_MAP2_COLOR_4)
      CALL fglEnd
      CALL EXPECT('Enable in a primitive', GL_INVALID_OPERATION)
      CALL CHECK('it is still off',
     &  .NOT. LOGICAL(fglIsEnabled(GL_MAP2_COLOR_4)))
C     The first error is kept.
      CALL fglEnable(GL_COEFF)
      CALL fglEnd
      CALL EXPECT('the first of two errors', GL_INVALID_ENUM)
      CALL EXPECT('then none', GL_NO_ERROR)
      END

C     The errors of Map1 and Map2 of both types, and that a map with an
C     error changes nothing.
      SUBROUTINE MAPERR
      INCLUDE 'fgl.inc'
      REAL*4 P(4, 200)
      REAL*8 P8(4, 200)
      INTEGER*4 MOST, TARGET1(2), TARGET2(2), ORD(2)
      INTEGER K
      DATA TARGET1 /GL_MAP1_VERTEX_4, GL_MAP1_INDEX/
      DATA TARGET2 /GL_MAP2_VERTEX_4, GL_MAP2_INDEX/
      P = 0.
      P8 = 0D0
      CALL fglGetIntegerv(GL_MAX_EVAL_ORDER, MOST)
      CALL CHECK('MAX_EVAL_ORDER', MOST .GE. 8 .AND. MOST .LT. 200)

      CALL fglMap1f(GL_MAP2_VERTEX_4, 0., 1., 4, 2, P)
      CALL EXPECT('Map1f: a name of MAP2', GL_INVALID_ENUM)
      CALL fglMap1d(GL_COEFF, 0D0, 1D0, 4, 2, P8)
      CALL EXPECT('Map1d: no name of a map', GL_INVALID_ENUM)
      CALL fglMap2f(GL_MAP1_VERTEX_4, 0., 1., 4, 2, 0., 1., 8, 2, P)
      CALL EXPECT('Map2f: a name of MAP1', GL_INVALID_ENUM)
      CALL fglMap2d(GL_COEFF, 0D0, 1D0, 4, 2, 0D0, 1D0, 8, 2, P8)
      CALL EXPECT('Map2d: no name of a map', GL_INVALID_ENUM)

      DO 10 K = 1, 2
        CALL fglMap1f(TARGET1(K), 0., 1., 4, 3, P)
        CALL fglMap2f(TARGET2(K), 0., 1., 4, 3, 0., 1., 12, 2, P)
        CALL EXPECT('maps without error', GL_NO_ERROR)

        CALL fglMap1f(TARGET1(K), 1., 1., 4, 2, P)
        CALL EXPECT('Map1f: u1 = u2', GL_INVALID_VALUE)
        CALL fglMap1d(TARGET1(K), 1D0, 1D0, 4, 2, P8)
        CALL EXPECT('Map1d: u1 = u2', GL_INVALID_VALUE)
        CALL fglMap2f(TARGET2(K), 1., 1., 4, 2, 0., 1., 8, 2, P)
        CALL EXPECT('Map2f: u1 = u2', GL_INVALID_VALUE)
        CALL fglMap2f(TARGET2(K), 0., 1., 4, 2, 1., 1., 8, 2, P)
        CALL EXPECT('Map2f: v1 = v2', GL_INVALID_VALUE)
        CALL fglMap2d(TARGET2(K), 1D0, 1D0, 4, 2, 0D0, 1D0, 8, 2, P8)
        CALL EXPECT('Map2d: u1 = u2', GL_INVALID_VALUE)
        CALL fglMap2d(TARGET2(K), 0D0, 1D0, 4, 2, 1D0, 1D0, 8, 2, P8)
        CALL EXPECT('Map2d: v1 = v2', GL_INVALID_VALUE)

C       4 values in VERTEX_4, 1 in INDEX: one less is an error.
        CALL fglMap1f(TARGET1(K), 0., 1., 6 - 3 * K, 2, P)
        CALL EXPECT('Map1f: stride', GL_INVALID_VALUE)
        CALL fglMap1d(TARGET1(K), 0D0, 1D0, 6 - 3 * K, 2, P8)
        CALL EXPECT('Map1d: stride', GL_INVALID_VALUE)
        CALL fglMap2f(TARGET2(K), 0., 1., 6 - 3 * K, 2, 0., 1., 8, 2, P)
        CALL EXPECT('Map2f: ustride', GL_INVALID_VALUE)
        CALL fglMap2f(TARGET2(K), 0., 1., 4, 2, 0., 1., 6 - 3 * K, 2, P)
        CALL EXPECT('Map2f: vstride', GL_INVALID_VALUE)
        CALL fglMap2d(TARGET2(K), 0D0, 1D0, 6 - 3 * K, 2, 0D0, 1D0, 8,
     &    2, P8)
        CALL EXPECT('Map2d: ustride', GL_INVALID_VALUE)
        CALL fglMap2d(TARGET2(K), 0D0, 1D0, 4, 2, 0D0, 1D0, 6 - 3 * K,
     &    2, P8)
        CALL EXPECT('Map2d: vstride', GL_INVALID_VALUE)

        CALL fglMap1f(TARGET1(K), 0., 1., 4, 0, P)
        CALL EXPECT('Map1f: order 0', GL_INVALID_VALUE)
        CALL fglMap1d(TARGET1(K), 0D0, 1D0, 4, MOST + 1, P8)
        CALL EXPECT('Map1d: order beyond the most', GL_INVALID_VALUE)
        CALL fglMap1f(TARGET1(K), 0., 1., 4, MOST + 1, P)
        CALL EXPECT('Map1f: order beyond the most', GL_INVALID_VALUE)
        CALL fglMap1d(TARGET1(K), 0D0, 1D0, 4, -1, P8)
        CALL EXPECT('Map1d: order -1', GL_INVALID_VALUE)
        CALL fglMap2f(TARGET2(K), 0., 1., 4, 0, 0., 1., 8, 2, P)
        CALL EXPECT('Map2f: uorder 0', GL_INVALID_VALUE)
        CALL fglMap2f(TARGET2(K), 0., 1., 4, 2, 0., 1., 8, MOST + 1, P)
        CALL EXPECT('Map2f: vorder beyond the most', GL_INVALID_VALUE)
        CALL fglMap2d(TARGET2(K), 0D0, 1D0, 4, MOST + 1, 0D0, 1D0, 8, 2,
     &    P8)
        CALL EXPECT('Map2d: uorder beyond the most', GL_INVALID_VALUE)
        CALL fglMap2d(TARGET2(K), 0D0, 1D0, 4, 2, 0D0, 1D0, 8, 0, P8)
        CALL EXPECT('Map2d: vorder 0', GL_INVALID_VALUE)

        CALL fglBegin(GL_POINTS)
        CALL fglMap1f(TARGET1(K), 0., 1., 4, 2, P)
        CALL fglEnd
        CALL EXPECT('Map1f in a primitive', GL_INVALID_OPERATION)
        CALL fglBegin(GL_POINTS)
        CALL fglMap1d(TARGET1(K), 0D0, 1D0, 4, 2, P8)
        CALL fglEnd
        CALL EXPECT('Map1d in a primitive', GL_INVALID_OPERATION)
        CALL fglBegin(GL_POINTS)
        CALL fglMap2f(TARGET2(K), 0., 1., 4, 2, 0., 1., 8, 2, P)
        CALL fglEnd
        CALL EXPECT('Map2f in a primitive', GL_INVALID_OPERATION)
        CALL fglBegin(GL_POINTS)
        CALL fglMap2d(TARGET2(K), 0D0, 1D0, 4, 2, 0D0, 1D0, 8, 2, P8)
        CALL fglEnd
        CALL EXPECT('Map2d in a primitive', GL_INVALID_OPERATION)

        CALL fglGetMapiv(TARGET1(K), GL_ORDER, ORD)
        CALL CHECK('the curve is as it was', ORD(1) .EQ. 3)
        CALL fglGetMapiv(TARGET2(K), GL_ORDER, ORD)
        CALL CHECK('the surface is as it was',
     &    ORD(1) .EQ. 3 .AND. ORD(2) .EQ. 2)
   10 CONTINUE
      END

C     The errors of GetMap and Get, which write nothing.
      SUBROUTINE QRYERR
      INCLUDE 'fgl.inc'
      REAL*4 F(4)
      REAL*8 D(4)
      INTEGER*4 I(4)
      F = 77.
      D = 77D0
      I = 77
      CALL fglGetMapfv(GL_COEFF, GL_ORDER, F)
      CALL EXPECT('GetMapfv: target', GL_INVALID_ENUM)
      CALL fglGetMapdv(GL_AUTO_NORMAL, GL_ORDER, D)
      CALL EXPECT('GetMapdv: target', GL_INVALID_ENUM)
      CALL fglGetMapiv(GL_POINT, GL_ORDER, I)
      CALL EXPECT('GetMapiv: target', GL_INVALID_ENUM)
      CALL fglGetMapfv(GL_MAP1_INDEX, GL_POINT, F)
      CALL EXPECT('GetMapfv: query', GL_INVALID_ENUM)
      CALL fglGetMapdv(GL_MAP1_INDEX, GL_MAP1_INDEX, D)
      CALL EXPECT('GetMapdv: query', GL_INVALID_ENUM)
      CALL fglGetMapiv(GL_MAP1_INDEX, 0, I)
      CALL EXPECT('GetMapiv: query', GL_INVALID_ENUM)
      CALL fglGetFloatv(GL_POINT, F)
      CALL EXPECT('GetFloatv: name', GL_INVALID_ENUM)
      CALL fglGetDoublev(GL_POINT, D)
      CALL EXPECT('GetDoublev: name', GL_INVALID_ENUM)
      CALL fglGetIntegerv(GL_POINT, I)
      CALL EXPECT('GetIntegerv: name', GL_INVALID_ENUM)
      CALL fglBegin(GL_POINTS)
      CALL fglGetMapfv(GL_MAP1_INDEX, GL_ORDER, F)
      CALL fglEnd
      CALL EXPECT('GetMapfv in a primitive', GL_INVALID_OPERATION)
      CALL fglBegin(GL_POINTS)
      CALL fglGetMapdv(GL_MAP1_INDEX, GL_ORDER, D)
      CALL fglEnd
      CALL EXPECT('GetMapdv in a primitive', GL_INVALID_OPERATION)
      CALL fglBegin(GL_POINTS)
      CALL fglGetMapiv(GL_MAP1_INDEX, GL_ORDER, I)
      CALL fglEnd
      CALL EXPECT('GetMapiv in a primitive', GL_INVALID_OPERATION)
      CALL CHECK('nothing is written', ALL(F .EQ. 77.) .AND. ALL(D .EQ.
     &  77D0) .AND. ALL(I .EQ. 77))
      END

C     The errors of MapGrid and EvalMesh.
      SUBROUTINE MSHERR
      INCLUDE 'fgl.inc'
      INTEGER N
      REAL*4 POS(3, 1000)
      COMMON /CAPTUR/ N, POS
      REAL*4 P(3), ENDS(4)
      INTEGER*4 SEG(2)
      DATA P /.5, .5, 0./
      CALL fglMapGrid1f(5, 2., 3.)
      CALL fglMapGrid2f(6, 2., 3., 7, 4., 5.)
      CALL EXPECT('grids without error', GL_NO_ERROR)
      CALL fglMapGrid1f(0, 0., 1.)
      CALL EXPECT('MapGrid1f: no segment', GL_INVALID_VALUE)
      CALL fglMapGrid1d(-1, 0D0, 1D0)
      CALL EXPECT('MapGrid1d: no segment', GL_INVALID_VALUE)
      CALL fglMapGrid2f(0, 0., 1., 1, 0., 1.)
      CALL EXPECT('MapGrid2f: no segment of u', GL_INVALID_VALUE)
      CALL fglMapGrid2d(1, 0D0, 1D0, -1, 0D0, 1D0)
      CALL EXPECT('MapGrid2d: no segment of v', GL_INVALID_VALUE)
      CALL fglBegin(GL_POINTS)
      CALL fglMapGrid1f(1, 0., 1.)
      CALL fglEnd
      CALL EXPECT('MapGrid1f in a primitive', GL_INVALID_OPERATION)
      CALL fglBegin(GL_POINTS)
      CALL fglMapGrid1d(1, 0D0, 1D0)
      CALL fglEnd
      CALL EXPECT('MapGrid1d in a primitive', GL_INVALID_OPERATION)
      CALL fglBegin(GL_POINTS)
      CALL fglMapGrid2f(1, 0., 1., 1, 0., 1.)
      CALL fglEnd
      CALL EXPECT('MapGrid2f in a primitive', GL_INVALID_OPERATION)
      CALL fglBegin(GL_POINTS)
      CALL fglMapGrid2d(1, 0D0, 1D0, 1, 0D0, 1D0)
      CALL fglEnd
      CALL EXPECT('MapGrid2d in a primitive', GL_INVALID_OPERATION)
      CALL fglGetIntegerv(GL_MAP1_GRID_SEGMENTS, SEG)
      CALL CHECK('the grid of curves is as it was', SEG(1) .EQ. 5)
      CALL fglGetIntegerv(GL_MAP2_GRID_SEGMENTS, SEG)
      CALL fglGetFloatv(GL_MAP2_GRID_DOMAIN, ENDS)
      CALL CHECK('the grid of surfaces is as it was', ALL(SEG .EQ. (/6,
     &  7/)) .AND. ALL(ENDS .EQ. (/2., 3., 4., 5./)))

      CALL fglMap1f(GL_MAP1_VERTEX_3, 0., 1., 3, 1, P)
      CALL fglMap2f(GL_MAP2_VERTEX_3, 0., 1., 3, 1, 0., 1., 3, 1, P)
      CALL fglEnable(GL_MAP1_VERTEX_3)
      CALL fglEnable(GL_MAP2_VERTEX_3)
      CALL EXPECT('maps without error', GL_NO_ERROR)
      CALL CAPBEG
      CALL fglEvalMesh1(GL_FILL, 0, 1)
      CALL EXPECT('EvalMesh1: FILL', GL_INVALID_ENUM)
      CALL fglEvalMesh2(GL_POINTS, 0, 1, 0, 1)
      CALL EXPECT('EvalMesh2: no mode', GL_INVALID_ENUM)
      CALL fglBegin(GL_POINTS)
      CALL fglEvalMesh1(GL_POINT, 0, 1)
      CALL fglEnd
      CALL EXPECT('EvalMesh1 in a primitive', GL_INVALID_OPERATION)
      CALL fglBegin(GL_POINTS)
      CALL fglEvalMesh2(GL_POINT, 0, 1, 0, 1)
      CALL fglEnd
      CALL EXPECT('EvalMesh2 in a primitive', GL_INVALID_OPERATION)
      CALL CAPEND
      CALL CHECK('nothing is drawn', N .EQ. 0)
      CALL fglDisable(GL_MAP1_VERTEX_3)
      CALL fglDisable(GL_MAP2_VERTEX_3)
      END
