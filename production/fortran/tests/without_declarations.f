C     FORTRAN 77 without the declarations: an argument is an array; the
C     names with p take a variable that holds an address.
      PROGRAM PLAIN
      INTEGER*8 CTX, ADDR
      CHARACTER*8 HOLDER
      REAL*4 P(3, 2, 2), V(12)
      REAL*8 D(4), Q(4, 2), W(8)
      INTEGER*4 ORD(2), fglevCreateContext, fglGetError
      LOGICAL*1 fglIsEnabled
      INTEGER I
      EQUIVALENCE (ADDR, HOLDER)
      DATA P /0., 1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11./
      DATA Q /1D0, 2D0, 3D0, 4D0, 5D0, 6D0, 7D0, 8D0/
      IF (fglevCreateContext(CTX) .NE. 0) STOP 1
      CALL fglevMakeCurrent(CTX)

      CALL fglMap2f(3511, 0., 1., 3, 2, 0., 1., 6, 2, P)
      CALL fglGetMapfv(3511, 2560, V)
      CALL CHECK('Map2f takes an array', V(1) .EQ. 0. .AND. V(4) .EQ.
     &  6. .AND. V(7) .EQ. 3. .AND. V(12) .EQ. 11.)
      CALL fglGetMapiv(3511, 2561, ORD)
      CALL CHECK('GetMapiv', ORD(1) .EQ. 2 .AND. ORD(2) .EQ. 2)
      CALL fglMap1d(3480, 0D0, 2D0, 4, 2, Q)
      CALL fglGetMapdv(3480, 2560, W)
      CALL CHECK('Map1d takes an array', W(1) .EQ. 1D0 .AND. W(8) .EQ.
     &  8D0)
      CALL fglEnable(3480)
      CALL CHECK('IsEnabled', LOGICAL(fglIsEnabled(3480)))

C     As the reference page declares it.
      ADDR = LOC(P(1, 2, 1))
      CALL fglMap2fp(3511, 0., 1., 3, 1, 0., 1., 6, 2, HOLDER)
      CALL fglGetMapfv(3511, 2560, V)
      CALL CHECK('Map2fp takes an address', V(1) .EQ. 3. .AND. V(4) .EQ.
     &  9.)
      ADDR = LOC(D)
      CALL fglGetMapdvp(3480, 2562, HOLDER)
      CALL CHECK('GetMapdvp takes an address', D(1) .EQ. 0D0 .AND.
     &  D(2) .EQ. 2D0)
      I = fglGetError()
      CALL CHECK('no error', I .EQ. 0)
      CALL fglEnable(2560)
      I = fglGetError()
      CALL CHECK('an error', I .EQ. 1280)
      CALL fglevDestroyContext(CTX)
      CALL FINISH
      END
