C     The declarations of fgl.inc and the tokens as a module.
      MODULE fgl
      IMPLICIT NONE
      INCLUDE 'fgl.inc'
      END MODULE
