# Renders a step with its program's default settings and compares the picture with the step's reference.
# cmake -D NAME=... -D PROGRAM=... -D COMPARE=... -D "EMULATOR=wine64" -D REFERENCES=folder -D OUT=folder -P reference.cmake
set(facts ${REFERENCES}/${NAME}.txt)
if(NOT EXISTS ${facts})
    message("[skipped] ${facts} does not exist; run ./learn references")
    return()
endif()

# The facts file lists the flags for a comparable picture; usually there are none, and the defaults apply.
file(STRINGS ${facts} flags REGEX "^test flags:")
string(REGEX REPLACE "^test flags: *" "" flags "${flags}")
separate_arguments(flags UNIX_COMMAND "${flags}")
set(variances "")
if(EXISTS ${REFERENCES}/${NAME}.variance.hdr) # a noisy step: compare with the variances of both
    list(APPEND flags --variance ${OUT}/${NAME}.variance.hdr)
    set(variances --variance-a ${OUT}/${NAME}.variance.hdr --variance-b ${REFERENCES}/${NAME}.variance.hdr)
endif()

file(MAKE_DIRECTORY ${OUT})
execute_process(COMMAND ${EMULATOR} ${PROGRAM} --quiet --out ${OUT}/${NAME} ${flags} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${EMULATOR} ${COMPARE} ${OUT}/${NAME}.hdr ${REFERENCES}/${NAME}.hdr ${variances}
                COMMAND_ERROR_IS_FATAL ANY)
