/* What the report and the page of the course share: the data, and elements made of text. */
const data = JSON.parse(document.getElementById("data").textContent);
const at = id => document.getElementById(id);

/* Creates an element. Strings become text nodes, so nothing in them is treated as markup. */
function make(tag, attributes, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
}

function capital(text) {
    return text.charAt(0).toUpperCase() + text.slice(1);
}
