/* A provider of contexts: what evalcts asks of a window system.
 *
 * With it, evalcts judges a GL on a window system, a platform or a device that it knows nothing of:
 *
 *   cc -shared -fPIC -I FOLDER_OF_THIS_HEADER -o provider.so provider.c -ldl
 *   evalcts run --context ./provider.so
 *   evalcts run --context ./provider.so --library ./libmygl.so    (commands from there, contexts from here)
 *
 * The provider is a shared library that exports evalcts_provider_open(). harness/examples/osmesa_provider.c
 * is a whole one. */
#ifndef EVALCTS_PROVIDER_H
#define EVALCTS_PROVIDER_H

#ifdef __cplusplus
extern "C" {
#endif

#define EVALCTS_PROVIDER_VERSION 1

typedef struct evalcts_provider {
  /* EVALCTS_PROVIDER_VERSION as it was when the provider was built. */
  unsigned int version;

  /* Makes a context in its initial state and makes it current in the calling thread. A compatibility context:
   * a core profile has no evaluators. Where drawing needs it, a framebuffer of some size comes with it,
   * complete, RGBA with depth and stencil (64 x 64 will do), and the viewport covers it. Returns what
   * destroy() is to get, or null where it failed; error() then says why. Never called while another context
   * exists, but thousands of times in one process. */
  void* (*create)(void);

  /* Destroys the context, which is current, and leaves none current. What is not freed here adds up. */
  void (*destroy)(void* context);

  /* The address of a GL command ("glMap1f"), or null where there is none. Called while the first context is
   * current; the address holds for all contexts. May be null itself where commands always come from
   * --library. */
  void* (*get_address)(const char* command);

  /* Why the last create() failed, and what to do about it. May be null. */
  const char* (*error)(void);
} evalcts_provider;

/* Called once, from the thread that calls everything else. What it returns stays valid until the process
 * ends. Null: the provider cannot be used. */
__attribute__((visibility("default"))) const evalcts_provider* evalcts_provider_open(void);

#ifdef __cplusplus
}
#endif

#endif
