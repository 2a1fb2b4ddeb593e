// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/diagnosis_json.h"
