# Writes the text of INPUT to OUTPUT as a C++ literal.
file(READ ${INPUT} text)
file(WRITE ${OUTPUT} "R\"idl(${text})idl\"\n")
