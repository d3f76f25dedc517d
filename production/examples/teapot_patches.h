/* The teapot of Martin Newell (University of Utah, 1975), with the bottom that was added later: 32 bicubic
 * Bezier patches. The numbers are those of F. C. Crow, "The Origins of the Teapot", IEEE Computer Graphics
 * and Applications 7(1), 1987, and are free to use. z is up, and the spout points along x. */
#ifndef TEAPOT_PATCHES_H_
#define TEAPOT_PATCHES_H_

enum { TEAPOT_PATCHES = 32 };

/* Computes the control points of patch `index`, 0 to 31: points[j][i] with i in the direction of u. The
 * automatic normal p_u x p_v points outward. Adjacent patches have the same control points on their common
 * edge. */
void teapot_patch(int index, float points[4][4][3]);

#endif /* TEAPOT_PATCHES_H_ */
