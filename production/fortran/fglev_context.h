/* The current context of a Fortran program: the routines that are not the GL's, and what fgl.c needs of them.
 */
#ifndef FGLEV_CONTEXT_H_
#define FGLEV_CONTEXT_H_

#include <glevaluator.h>

/* The context that commands of this thread go to, or null. */
glev_context* fglev_current(void);

#endif /* FGLEV_CONTEXT_H_ */
