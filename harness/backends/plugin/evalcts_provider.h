/* A provider: it makes GL contexts for evalcts.
 *
 * With a provider, evalcts judges a GL on a window system, platform or device that it does not support
 * itself:
 *
 *   cc -shared -fPIC -I FOLDER_OF_THIS_HEADER -o provider.so provider.c -ldl
 *   evalcts run --context ./provider.so
 *   evalcts run --context ./provider.so --library ./libmygl.so    (commands of the library)
 *
 * The provider is a shared library that exports evalcts_provider_open(). harness/examples/osmesa_provider.c
 * is a complete provider. */
#ifndef EVALCTS_PROVIDER_H
#define EVALCTS_PROVIDER_H

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. */
#define EVALCTS_PROVIDER_VERSION 3

/* The functions of a provider, which evalcts_provider_open() returns. */
typedef struct evalcts_provider {
  /* The EVALCTS_PROVIDER_VERSION that the provider was built with. */
  unsigned int version;

  /* Creates a compatibility context in its initial state (a core profile has no evaluators) and makes it
   * current in the calling thread. If drawing needs a framebuffer, the context has a complete one, RGBA with
   * depth and stencil (64 x 64 is enough), which the viewport covers. Returns the argument for destroy(), or
   * null if it fails; error() then returns the reason. Called thousands of times in one process, but never
   * while another context exists, unless there is make_current(). */
  void* (*create)(void);

  /* Destroys the current context and leaves none current. Must free everything, because it is called
   * thousands of times. */
  void (*destroy)(void* context);

  /* Returns the address of a GL command ("glMap1f"), or null if there is none. Called while the first context
   * is current; the address must be valid for all contexts. This pointer may be null if --library supplies
   * all commands. */
  void* (*get_address)(const char* command);

  /* Returns the reason for which the last create() failed, and what to do about it. Called directly after
   * create(). The text is copied at once. The pointer may be null. */
  const char* (*error)(void);

  /* The next two functions are read from providers of version 2 and newer. Their pointers may be null. */

  /* Makes a context current in the calling thread; returns 0 if it fails. If the pointer is not null, several
   * contexts can exist at a time, and tests of several contexts are run. destroy() is then called for the
   * current one among them. */
  int (*make_current)(void* context);

  /* The same as create(), but the context is a colour-index one (GL_RGBA_MODE is false) with at least 8 bits
   * for each index. INDEX maps are judged in it. Called while a context of create() exists, so that
   * make_current() is needed as well. */
  void* (*create_color_index)(void);

  /* The function below is read from providers of version 3. Its pointer may be null. */

  /* Makes no context current in the calling thread. If neither this pointer nor make_current() is null, tests
   * of several threads are run: any thread may call the functions above, but not two threads at once, while
   * others issue GL commands in contexts of their own. A context is then created in one thread and may be
   * made current in another after its release. */
  void (*release)(void);
} evalcts_provider;

/* Returns the provider, which must stay valid until the process ends, or null if it cannot be used. Called
 * once, from the thread that calls everything else, unless there is release(). */
__attribute__((visibility("default"))) const evalcts_provider* evalcts_provider_open(void);

#ifdef __cplusplus
}
#endif

#endif
