/* A sink (evalcts_sink.h) whose evaluators are those of python_sink.py, run by a Python in this process.
 * PYTHONPATH has to name the folder of python_sink.py. record_detections.py compiles this file. */
#include <Python.h>
#include <dlfcn.h>
#include <evalcts_sink.h>

const evalcts_sink* evalcts_sink_open(void) {
  Dl_info python;
  PyObject *module, *address;
  /* Extension modules of Python look up its functions in the global scope. */
  if (!dladdr((void*)Py_InitializeEx, &python) ||
      !dlopen(python.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL))
    return NULL;
  Py_InitializeEx(0);
  module = PyImport_ImportModule("python_sink");
  address = module ? PyObject_GetAttrString(module, "ADDRESS") : NULL;
  if (!address) {
    PyErr_Print();
    return NULL;
  }
  return (const evalcts_sink*)PyLong_AsVoidPtr(address);
}
