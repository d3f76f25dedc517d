/* The current context of a Fortran program, for fgl.c. */
#ifndef FGLEV_CONTEXT_H_
#define FGLEV_CONTEXT_H_

#include <glevaluator.h>

/* Returns the current context of this thread, or null. */
glev_context* fglev_current(void);

#endif /* FGLEV_CONTEXT_H_ */
