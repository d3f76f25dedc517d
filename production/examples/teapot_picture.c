/* Draws the teapot into a PNG file of 800 x 600 pixels: teapot_picture FILE
 * The vertices come from glevaluator (teapot_mesh.c); the GL, a core profile (core_profile.c), draws
 * triangles. Exit code 77 if there is no such GL. */
#include <math.h>
#include <png.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include "core_profile.h"
#include "teapot_mesh.h"

enum { WIDTH = 800, HEIGHT = 600, SCALE = 2, SAMPLES = 4, SEGMENTS = 24 };
enum { BACKGROUND, SHADOW, TEAPOT }; /* the object that a pass draws */

static const char vertex_shader[] =
    "#version 330 core\n"
    "in vec3 position, normal;\n"
    "uniform mat4 camera;\n"
    "uniform vec3 light;\n"
    "uniform int drawn;\n"
    "out vec3 at, n;\n"
    "void main() {\n"
    "  at = position;\n"
    "  n = normal;\n"
    "  if (drawn == 0) {\n" /* a triangle that covers everything */
    "    gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0.9999, 1);\n"
    "    at.z = gl_Position.y;\n"
    "  } else if (drawn == 1) {\n" /* projects along the light onto the table, z = 0 */
    "    gl_Position = camera * vec4(position - light * (position.z / light.z), 1);\n"
    "  } else {\n"
    "    gl_Position = camera * vec4(position, 1);\n"
    "  }\n"
    "}\n";

static const char fragment_shader[] =
    "#version 330 core\n"
    "in vec3 at, n;\n"
    "uniform vec3 light, eye;\n"
    "uniform int drawn;\n"
    "out vec4 color;\n"
    "void main() {\n"
    "  if (drawn == 0) {\n"
    "    color = vec4(mix(vec3(0.62, 0.55, 0.46), vec3(0.84, 0.85, 0.86), smoothstep(-1.0, 1.0, at.z)), 1);\n"
    "  } else if (drawn == 1) {\n"
    "    color = vec4(0.30, 0.25, 0.20, 1);\n"
    "  } else {\n"
    "    vec3 facing = normalize(gl_FrontFacing ? n : -n), view = normalize(eye - at);\n"
    "    vec3 glaze = vec3(0.045, 0.25, 0.27);\n"
    "    float sky = 0.5 + 0.5 * facing.z, rim = pow(1.0 - max(dot(facing, view), 0.0), 4.0);\n"
    "    float shine = pow(max(dot(facing, normalize(light + view)), 0.0), 90.0);\n"
    "    vec3 ambient = mix(vec3(0.30, 0.24, 0.18), vec3(0.55, 0.60, 0.65), sky);\n"
    "    color = vec4(glaze * (ambient + 1.6 * max(dot(facing, light), 0.0)) + 0.75 * shine + 0.22 * rim * "
    "sky, 1);\n"
    "  }\n"
    "}\n";

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const float a[3], const float b[3], float result[3]) {
  for (int i = 0; i < 3; ++i) result[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalize(float v[3]) {
  const float length = sqrtf(dot(v, v));
  for (int i = 0; i < 3; ++i) v[i] /= length;
}

/* Computes a perspective matrix, by columns, from `eye` towards `target`, with z up. `zoom` is the cotangent
 * of half the vertical angle. */
static void look(const float eye[3], const float target[3], float zoom, float camera[16]) {
  static const float up[3] = {0, 0, 1}, near = 1, far = 50;
  float axes[3][3]; /* right, up, back */
  for (int i = 0; i < 3; ++i) axes[2][i] = eye[i] - target[i];
  normalize(axes[2]);
  cross(up, axes[2], axes[0]);
  normalize(axes[0]);
  cross(axes[2], axes[0], axes[1]);
  const float scale[3] = {zoom * HEIGHT / WIDTH, zoom, (far + near) / (near - far)};
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 3; ++i) camera[4 * i + row] = scale[row] * axes[row][i];
    camera[12 + row] = -scale[row] * dot(axes[row], eye);
  }
  camera[14] += 2 * far * near / (near - far);
  for (int i = 0; i < 3; ++i) camera[4 * i + 3] = -axes[2][i];
  camera[15] = dot(axes[2], eye);
}

static GLuint make_program(const core_profile* gl) {
  const GLuint program = gl->CreateProgram();
  const GLenum kinds[2] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER};
  const char* sources[2] = {vertex_shader, fragment_shader};
  for (int i = 0; i < 2; ++i) {
    const GLuint shader = gl->CreateShader(kinds[i]);
    gl->ShaderSource(shader, 1, &sources[i], NULL);
    gl->CompileShader(shader);
    gl->AttachShader(program, shader);
  }
  gl->BindAttribLocation(program, 0, "position");
  gl->BindAttribLocation(program, 1, "normal");
  gl->LinkProgram(program);
  GLint linked;
  gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  char log[4096];
  gl->GetProgramInfoLog(program, sizeof log, NULL, log);
  fprintf(stderr, "%s\n", log);
  return 0;
}

/* Makes a framebuffer for sRGB colours, `scale` times as large as the picture, with a depth buffer if
 * `samples` is not 0. */
static GLuint make_framebuffer(const core_profile* gl, GLsizei scale, GLsizei samples) {
  GLuint framebuffer, renderbuffers[2];
  gl->GenFramebuffers(1, &framebuffer);
  gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl->GenRenderbuffers(2, renderbuffers);
  gl->BindRenderbuffer(GL_RENDERBUFFER, renderbuffers[0]);
  gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_SRGB8_ALPHA8, scale * WIDTH,
                                     scale * HEIGHT);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffers[0]);
  if (samples) {
    gl->BindRenderbuffer(GL_RENDERBUFFER, renderbuffers[1]);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, scale * WIDTH,
                                       scale * HEIGHT);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, renderbuffers[1]);
  }
  return gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ? framebuffer : 0;
}

/* Uploads the vertex buffer and the index buffer unchanged. */
static void upload(const core_profile* gl, const teapot_mesh* mesh) {
  GLuint array, buffers[2];
  gl->GenVertexArrays(1, &array);
  gl->BindVertexArray(array);
  gl->GenBuffers(2, buffers);
  gl->BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(mesh->vertex_count * sizeof *mesh->vertices), mesh->vertices,
                 GL_STATIC_DRAW);
  gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(mesh->index_count * sizeof *mesh->indices),
                 mesh->indices, GL_STATIC_DRAW);
  const char* const start = NULL; /* start of the buffer */
  gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(teapot_vertex),
                          start + offsetof(teapot_vertex, position));
  gl->VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(teapot_vertex),
                          start + offsetof(teapot_vertex, normal));
  gl->EnableVertexAttribArray(0);
  gl->EnableVertexAttribArray(1);
}

static int draw(const core_profile* gl, const teapot_mesh* mesh, unsigned char* pixels) {
  static const float eye[3] = {2.4f, -9.6f, 5.6f}, target[3] = {0.25f, 0, 1.25f};
  float light[3] = {-0.45f, -0.35f, 1}, camera[16];
  normalize(light);
  look(eye, target, 3.1f, camera);
  /* Four samples per pixel smooth edges; rendering at twice the size smooths highlights as well. */
  const GLuint program = make_program(gl), shown = make_framebuffer(gl, 1, 0),
               large = make_framebuffer(gl, SCALE, 0), drawn = make_framebuffer(gl, SCALE, SAMPLES);
  if (!program || !shown || !large || !drawn) return 0;
  upload(gl, mesh);
  gl->UseProgram(program);
  gl->UniformMatrix4fv(gl->GetUniformLocation(program, "camera"), 1, GL_FALSE, camera);
  gl->Uniform3fv(gl->GetUniformLocation(program, "light"), 1, light);
  gl->Uniform3fv(gl->GetUniformLocation(program, "eye"), 1, eye);
  const GLint pass = gl->GetUniformLocation(program, "drawn");
  const GLsizei count = (GLsizei)mesh->index_count;

  gl->Viewport(0, 0, SCALE * WIDTH, SCALE * HEIGHT);
  gl->Enable(GL_FRAMEBUFFER_SRGB);
  gl->Clear(GL_DEPTH_BUFFER_BIT);
  gl->Uniform1i(pass, BACKGROUND);
  gl->DrawArrays(GL_TRIANGLES, 0, 3);
  gl->Uniform1i(pass, SHADOW);
  gl->DrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, NULL);
  gl->Enable(GL_DEPTH_TEST);
  gl->Uniform1i(pass, TEAPOT);
  gl->DrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, NULL);

  gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, large);
  gl->BlitFramebuffer(0, 0, SCALE * WIDTH, SCALE * HEIGHT, 0, 0, SCALE * WIDTH, SCALE * HEIGHT,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl->BindFramebuffer(GL_READ_FRAMEBUFFER, large);
  gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, shown);
  gl->BlitFramebuffer(0, 0, SCALE * WIDTH, SCALE * HEIGHT, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT,
                      GL_LINEAR);
  gl->BindFramebuffer(GL_READ_FRAMEBUFFER, shown);
  gl->ReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  return gl->GetError() == GL_NO_ERROR;
}

/* Writes the picture. The first row of the GL is the lowest one. */
static int write_png(const char* name, const unsigned char* pixels) {
  png_image image = {
      .version = PNG_IMAGE_VERSION, .width = WIDTH, .height = HEIGHT, .format = PNG_FORMAT_RGBA};
  return png_image_write_to_file(&image, name, 0, pixels, -4 * WIDTH, NULL);
}

int main(int argc, char** argv) {
  static unsigned char pixels[WIDTH * HEIGHT * 4];
  if (argc != 2) {
    fprintf(stderr, "usage: %s FILE\n", argv[0]);
    return 2;
  }
  core_profile gl;
  if (!make_core_profile(&gl)) {
    fprintf(stderr, "no core profile of OpenGL 3.3 by EGL\n");
    return 77;
  }
  printf("%s\n", (const char*)gl.GetString(GL_VERSION));
  teapot_mesh mesh;
  if (!teapot_create_mesh(SEGMENTS, &mesh)) return 1;
  const int drawn = draw(&gl, &mesh, pixels);
  teapot_free_mesh(&mesh);
  if (!drawn) fprintf(stderr, "the GL cannot draw it\n");
  if (!drawn || !write_png(argv[1], pixels)) return 1;
  return 0;
}
