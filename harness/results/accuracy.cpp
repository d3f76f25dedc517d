// Adds the statistics of several tests.
#include <evalcts/results/accuracy.h>

namespace evalcts {

void Accuracy::add(const Accuracy& other) {
  values += other.values;
  not_correctly_rounded += other.not_correctly_rounded;
  all_terms_zero += other.all_terms_zero;
  all_terms_zero_wrong += other.all_terms_zero_wrong;
  not_judged += other.not_judged;
  if (other.ulp.error > ulp.error) ulp = other.ulp;
  if (other.condition_aware.error > condition_aware.error) condition_aware = other.condition_aware;
}

}  // namespace evalcts
