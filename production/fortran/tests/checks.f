C     Counts checks, and prints a line for each failure.
      SUBROUTINE CHECK(TEXT, HOLDS)
      CHARACTER*(*) TEXT
      LOGICAL HOLDS
      INTEGER CHECKS, FAILED
      COMMON /TALLY/ CHECKS, FAILED
      CHECKS = CHECKS + 1
      IF (HOLDS) RETURN
      FAILED = FAILED + 1
      WRITE (*, '(2A)') 'does not hold: ', TEXT
      END

C     Expects that the first error since the last call is CODE.
      SUBROUTINE EXPECT(TEXT, CODE)
      CHARACTER*(*) TEXT
      INTEGER*4 CODE, FOUND, fglGetError
      EXTERNAL fglGetError
      FOUND = fglGetError()
      CALL CHECK(TEXT, FOUND .EQ. CODE)
      IF (FOUND .NE. CODE) WRITE (*, '(2(A, I5))')
     &  '  the error is', FOUND, ', expected', CODE
      END

C     Prints the result; without this call, the exit code is 1.
      SUBROUTINE FINISH
      INTEGER CHECKS, FAILED
      COMMON /TALLY/ CHECKS, FAILED
      WRITE (*, '(I4, A, I4, A)') CHECKS, ' checks, ', FAILED, ' failed'
      IF (FAILED .NE. 0 .OR. CHECKS .EQ. 0) STOP 1
      END

      BLOCK DATA
      INTEGER CHECKS, FAILED
      COMMON /TALLY/ CHECKS, FAILED
      DATA CHECKS, FAILED /0, 0/
      END
