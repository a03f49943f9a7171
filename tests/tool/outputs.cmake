# Runs the main job in an empty folder, then opens what it wrote with VTK from Python.
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${PALPATE} simulate ${SCENE} --out ${WORK} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND /usr/bin/python3 ${CHECK} ${WORK} COMMAND_ERROR_IS_FATAL ANY)
