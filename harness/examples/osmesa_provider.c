/* A provider of contexts for evalcts, over Mesa's off-screen library: a template for your own.
 *
 *   cc -shared -fPIC -I harness/backends/plugin -o provider.so harness/examples/osmesa_provider.c -ldl
 *   evalcts run --context ./provider.so */
#include <dlfcn.h>
#include <evalcts_provider.h>
#include <stddef.h>
#include <stdio.h>

enum { kRgba = 0x1908, kUnsignedByte = 0x1401, kSide = 64 };

typedef void* (*CreateContextExt)(unsigned format, int depth, int stencil, int accumulation, void* share);
typedef unsigned char (*MakeCurrent)(void* context, void* pixels, unsigned type, int width, int height);
typedef void (*DestroyContext)(void* context);

static void* library;
static CreateContextExt create_context;
static MakeCurrent make_current;
static DestroyContext destroy_context;
static const char* what_went_wrong;
static char loader_message[512];
static _Thread_local unsigned char pixels[kSide * kSide * 4]; /* several threads may draw at once */

static int make_context_current(void* context) {
  return make_current(context, pixels, kUnsignedByte, kSide, kSide);
}

static void* create(void) {
  void* context;
  if (!library) {
    library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      /* The next call of a dl function invalidates the message, so it is copied. */
      snprintf(loader_message, sizeof loader_message, "%s", dlerror());
      what_went_wrong = loader_message;
      return NULL;
    }
    create_context = (CreateContextExt)dlsym(library, "OSMesaCreateContextExt");
    make_current = (MakeCurrent)dlsym(library, "OSMesaMakeCurrent");
    destroy_context = (DestroyContext)dlsym(library, "OSMesaDestroyContext");
  }
  if (!create_context || !make_current || !destroy_context) {
    what_went_wrong = "libOSMesa.so.8 is not OSMesa";
    return NULL;
  }
  context = create_context(kRgba, 24, 8, 0, NULL);
  if (!context) {
    what_went_wrong = "OSMesaCreateContextExt failed";
    return NULL;
  }
  if (!make_context_current(context)) {
    destroy_context(context);
    what_went_wrong = "OSMesaMakeCurrent failed";
    return NULL;
  }
  return context;
}

static void release(void) { make_current(NULL, NULL, kUnsignedByte, 0, 0); }

static void destroy(void* context) {
  release();
  destroy_context(context);
}

static void* get_address(const char* command) { return dlsym(library, command); }

static const char* error(void) { return what_went_wrong; }

const evalcts_provider* evalcts_provider_open(void) {
  static const evalcts_provider kProvider = {EVALCTS_PROVIDER_VERSION,
                                             create,
                                             destroy,
                                             get_address,
                                             error,
                                             make_context_current,
                                             NULL /* OSMesa has no colour-index contexts */,
                                             release};
  return &kProvider;
}
