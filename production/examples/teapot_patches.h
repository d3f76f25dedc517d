/* The teapot that Martin Newell drew at the University of Utah in 1975, with the bottom that it got later: 32
 * bicubic Bezier patches. The numbers are those of F. C. Crow, "The Origins of the Teapot", IEEE Computer
 * Graphics and Applications 7(1), 1987, free for everybody's use ever since. z is up, the spout points along
 * x. */
#ifndef TEAPOT_PATCHES_H_
#define TEAPOT_PATCHES_H_

enum { TEAPOT_PATCHES = 32 };

/* The control points of patch `index`, 0 to 31, points[j][i] with i in the direction of u. u_x p_v, the
 * automatic normal, points outward. Patches that touch have the same control points there. */
void teapot_patch(int index, float points[4][4][3]);

#endif /* TEAPOT_PATCHES_H_ */
