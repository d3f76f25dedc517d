C     The declarations of fglev.inc as a module, those of fgl.inc included.
      MODULE fglev
      IMPLICIT NONE
      INCLUDE 'fglev.inc'
      END MODULE
