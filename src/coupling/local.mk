libskerry_la_SOURCES += \
	src/coupling/coupling.c src/coupling/coupling.h src/coupling/coupling_list.h \
	src/coupling/fixed_point.c \
	src/coupling/interface.c src/coupling/interface.h \
	src/coupling/one_field.c \
	src/coupling/quasi_newton.c src/coupling/quasi_newton.h \
	src/coupling/relaxation.c src/coupling/relaxation.h \
	src/coupling/sub_cycled.c
